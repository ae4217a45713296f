# SPDX-License-Identifier: GPL-3.0-or-later
"""How much room the skirt leaves on the mannequin: fit.py FOLDER writes coloured.ply there."""
import sys
from pathlib import Path

import numpy as np

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    skirt, body = furrow.read_mesh(MESHES / "skirt.obj"), furrow.read_mesh(MESHES / "mannequin.obj")
    fitted = furrow.fit(skirt, body=body, rest_shape=skirt, colour="distance", output=folder / "coloured.ply")
    assert fitted.mesh is not None
    distance = fitted.mesh.vertex["fit_distance"]
    print(f"median distance {np.median(distance) * 1000:.1f} mm, largest {distance.max() * 1000:.1f} mm")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
