# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a ridge of 20 mm across a sheet of cloth: wrinkle.py FOLDER writes ridged.ply there."""
import sys
from pathlib import Path

import numpy as np

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    x = np.linspace(-0.25, 0.25, 50)
    ridge = {"name": "ridge", "height": 0.02, "width": 0.08,
             "points": np.column_stack([x, np.full_like(x, 0.5), np.zeros_like(x)])}
    drawn = furrow.wrinkle(MESHES / "sheet.obj", [ridge], output=folder / "ridged.ply")
    assert drawn.mesh is not None
    on_line = drawn.mesh.vertex["line"] >= 0
    print(f"{on_line.sum()} vertices on the ridge, up to {drawn.mesh.V[on_line, 2].max() * 1000:.1f} mm high")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
