# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run, and write what they say; there is one for each job."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import furrow
from paths import SOURCE

EXAMPLES = SOURCE / "examples" / "python"
WRITTEN = {"arrays": "hung.ply", "wrinkle": "ridged.ply", "simulate": "swung.ply", "drape": "worn.ply", "keep": "kept.ply",
           "chart": "chart.csv", "fit": "coloured.ply", "transfer": "folded.obj", "bake": "sheet_normal.png",
           "subdivide": "fine.ply", "body": "anna.obj", "doctor": "mended.obj", "quality": "quality.json"}


class Examples(unittest.TestCase):
    def test_each_job_has_one_that_runs(self):
        self.assertEqual({p.stem for p in EXAMPLES.glob("*.py")}, set(WRITTEN))
        texts = "".join(p.read_text() for p in EXAMPLES.glob("*.py"))
        for job in furrow._JOBS:
            self.assertIn(f"furrow.{job}(", texts)
        for name in sorted(WRITTEN):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-B", EXAMPLES / f"{name}.py", folder], capture_output=True,
                                      text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertGreater((pathlib.Path(folder) / WRITTEN[name]).stat().st_size, 0)
                self.assertTrue(done.stdout.strip())


if __name__ == "__main__":
    unittest.main()
