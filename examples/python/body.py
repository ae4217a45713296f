# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives the mannequin a person's measurements: body.py FOLDER writes anna.obj there."""
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    anna = furrow.body(MESHES / "mannequin.obj", height=1.68, chest=0.92, waist=0.74, hip=0.98, output=folder / "anna.obj")
    for name, girth in anna.report["reached"].items():
        print(f"{name}: {100 * girth:.1f} cm")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
