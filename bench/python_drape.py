# SPDX-License-Identifier: GPL-3.0-or-later
"""Processor time of the same drape from Python and by the command line, in pairs, in turns which of them goes first.

    PYTHONPATH=build/release/python python3 bench/python_drape.py build/release/furrow [PAIRS]
"""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import furrow

SHEET = Path(__file__).resolve().parents[1] / "meshes" / "hung_sheet.obj"


def by_program(program, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "drape", SHEET, "--pin-loop", "top", "--subdivide", "0", "--threads", "1", "-q",
                    "-o", os.path.join(folder, "program.ply")], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def by_package(folder):
    before = time.process_time()
    furrow.drape(SHEET, pin_loop="top", subdivide=0, threads=1, output=os.path.join(folder, "package.ply"))
    return time.process_time() - before


def main(program, pairs):
    ratios, times = [], []
    with tempfile.TemporaryDirectory() as folder:
        for i in range(pairs):
            order = [lambda: ("program", by_program(program, folder)), lambda: ("package", by_package(folder))]
            seconds = dict(run() for run in (order if i % 2 else order[::-1]))
            times.append(seconds["program"])
            ratios.append(seconds["package"] / seconds["program"])
        same = Path(folder, "program.ply").read_bytes() == Path(folder, "package.ply").read_bytes()
    low, middle, high = statistics.quantiles(ratios, n=4)
    print(f"package over program, {pairs} pairs: median {middle:.3f}, quartiles {low:.3f} to {high:.3f}; "
          f"program {statistics.median(times):.2f} s; the same file: {'yes' if same else 'no'}")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 11)
