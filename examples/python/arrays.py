# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a cloth of arrays, hangs it, and looks at it with numpy: arrays.py FOLDER writes hung.ply there."""
import sys
from pathlib import Path

import numpy as np

import furrow


def main(folder: Path) -> None:
    n = 21
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 0.6, n), np.linspace(0, 0.6, n)))
    quads = [[i * n + j, i * n + j + 1, (i + 1) * n + j + 1, (i + 1) * n + j] for i in range(n - 1) for j in range(n - 1)]
    towel = furrow.Mesh(np.column_stack([u, np.full_like(u, 1.0), v]), quads, name="towel")
    hung = furrow.drape(towel, pin_vertices=[0, n - 1], fabric="denim", subdivide=0)
    assert hung.mesh is not None
    lengths = np.linalg.norm(np.diff(hung.mesh.V[hung.mesh.E], axis=1)[:, 0], axis=1)
    print(furrow.info(hung.mesh)["vertices"], "vertices; edges from", lengths.min(), "to", lengths.max(), "m")
    hung.mesh.write(folder / "hung.ply")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
