# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the shirt on the mannequin: drape.py FOLDER writes worn.ply there."""
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    worn = furrow.drape(MESHES / "shirt.obj", body=MESHES / "mannequin.obj", fabric="cotton",
                        output=folder / "worn.ply", subdivide=0,
                        progress=lambda what, share: print(f"\r{what}: {share:4.0%}", end="", file=sys.stderr))
    assert worn.mesh is not None
    strain = worn.mesh.vertex["strain"]
    print(f"{worn.report['outcome']}; strained by {strain.max():.1%} at most")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
