# SPDX-License-Identifier: GPL-3.0-or-later
"""How well the skirt's folds are shaped, as drawn: quality.py FOLDER writes quality.json there."""
import json
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    drawn = furrow.wrinkle(MESHES / "skirt.obj", MESHES / "strokes" / "waist_drapes.json")
    assert drawn.mesh is not None
    judged = furrow.quality(drawn.mesh)
    for measure in judged.report["measures"]:
        print(measure["id"], measure["name"], measure["value"])
    (folder / "quality.json").write_text(json.dumps(judged.report, indent=2))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
