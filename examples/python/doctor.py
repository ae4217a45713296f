# SPDX-License-Identifier: GPL-3.0-or-later
"""Mends a soup of loose triangles, as exporters write them: doctor.py FOLDER writes mended.obj there."""
import sys
from pathlib import Path

import numpy as np

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    skirt = furrow.read_mesh(MESHES / "skirt.obj")
    soup = furrow.Mesh(skirt.V[skirt.F].reshape(-1, 3), np.arange(3 * len(skirt.F)).reshape(-1, 3), name="soup")
    for ailment in furrow.doctor(soup).report["found"]:
        print(ailment["code"], "-", ailment["text"])
    mended = furrow.doctor(soup, repair=True, output=folder / "mended.obj")
    print(mended.mesh, "is well" if mended.succeeded else "is not well")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
