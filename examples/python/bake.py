# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes a ridge into maps of a plain sheet: bake.py FOLDER writes sheet_normal.png and others there."""
import sys
from pathlib import Path

import numpy as np

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    sheet = furrow.read_mesh(MESHES / "sheet.obj")
    corners = sheet.V[sheet.F][:, :, :2]
    sheet.corner["texture"] = np.clip(corners + [0.5, 0], 0, 1)
    ridge = {"name": "ridge", "height": 0.02, "points": [[-0.25, 0.5, 0], [0.25, 0.5, 0]]}
    drawn = furrow.wrinkle(sheet, [ridge])
    assert drawn.mesh is not None
    baked = furrow.bake(sheet, drawn.mesh, texels=256, output=folder / "sheet")
    print(*baked.report["written"], sep="\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
