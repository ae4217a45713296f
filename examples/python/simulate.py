# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets a sheet swing from one corner and follows its lowest point: simulate.py FOLDER writes swung.ply there."""
import sys
from pathlib import Path
from typing import List, Tuple

import furrow

MESHES = Path(__file__).resolve().parents[2] / "meshes"


def main(folder: Path) -> None:
    lowest: List[Tuple[float, float]] = []
    run = furrow.simulate(MESHES / "sheet.obj", seconds=0.5, fabric="cotton", integrator="implicit",
                          pin_box=[-0.51, 0.99, -1, -0.49, 1.01, 1], output=folder / "swung.ply",
                          watch=lambda time, V: lowest.append((time, float(V[:, 1].min()))))
    for time, y in lowest[::10]:
        print(f"{time:.2f} s: lowest point at {y:.3f} m")
    print(run.report["outcome"])


if __name__ == "__main__":
    main(Path(sys.argv[1]))
