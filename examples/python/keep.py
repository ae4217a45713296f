# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives a hung sheet the rest state that holds its ridges: keep.py FOLDER writes kept.ply there."""
import sys
from pathlib import Path

import furrow

ROOT = Path(__file__).resolve().parents[2]


def main(folder: Path) -> None:
    kept = furrow.keep(ROOT / "scenes" / "kept_sheet.toml", run=1, gust=0, output=folder / "kept.ply",
                       settings={"output.state": str(folder / "kept-state.ply")})
    for line in kept.report["lines"]:
        print(line["name"], line["verdict"])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
