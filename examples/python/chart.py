# SPDX-License-Identifier: GPL-3.0-or-later
"""Which integrator and step a hung sheet bears within 2 % of its size: chart.py FOLDER writes chart.csv there."""
import sys
from pathlib import Path

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    judged = furrow.chart(MESHES / "hung_sheet.obj", accuracy=0.02, budget=5, csv=folder / "chart.csv",
                          settings={"simulation.seconds": 0.1, "pins": [{"loop": "top"}]})
    for candidate in judged.report["candidates"]:
        print(candidate["name"], candidate["verdict"])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
