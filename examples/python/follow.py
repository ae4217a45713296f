# SPDX-License-Identifier: GPL-3.0-or-later
"""A shirt that goes along with its wearer's chest and waist: follow.py FOLDER writes follows.glb there."""
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    shapes = {"broad": {"chest": 1.0}, "wide": {"waist": 0.80}}
    for name, measures in shapes.items():
        furrow.body(MESHES / "mannequin.obj", **measures, output=folder / f"{name}.obj")
    follows = furrow.follow(MESHES / "shirt.obj", body=MESHES / "mannequin.obj",
                            body_keys=[folder / f"{name}.obj" for name in shapes], output=folder / "follows.glb")
    for key in follows.report["keys"]:
        print(f"{key['name']}: moves {key['vertices']} vertices by up to {1000 * key['farthest']:.0f} mm")
    print(f"the body comes through by {1000 * follows.report['mixes_most']:.1f} mm at most, in {follows.report['mixes']} mixtures")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
