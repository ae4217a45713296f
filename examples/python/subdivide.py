# SPDX-License-Identifier: GPL-3.0-or-later
"""Refines the skirt and smooths it: subdivide.py FOLDER writes fine.ply there."""
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    skirt = furrow.read_mesh(MESHES / "skirt.obj")
    fine = furrow.subdivide(skirt, subdivide=1).mesh
    assert fine is not None
    smooth = furrow.smooth(fine, iterations=5, keep_border=True, output=folder / "fine.ply").mesh
    print(skirt, fine, smooth, sep="\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
