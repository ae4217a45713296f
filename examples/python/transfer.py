# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws folds on the skirt and brings them back to its own vertices: transfer.py FOLDER writes folded.obj there."""
import sys
from pathlib import Path

import numpy as np

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    skirt = furrow.read_mesh(MESHES / "skirt.obj")
    drawn = furrow.wrinkle(skirt, MESHES / "strokes" / "waist_drapes.json")
    assert drawn.mesh is not None
    back = furrow.transfer(skirt, drawn.mesh, output=folder / "folded.obj")
    assert back.mesh is not None
    moved = np.linalg.norm(back.mesh.V - skirt.V, axis=1)
    print(f"{len(drawn.mesh.V)} vertices back to {len(back.mesh.V)}; moved by {moved.max() * 1000:.1f} mm at most")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
