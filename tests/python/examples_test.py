# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run, and write what they say; there is one for each job."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import furrow
from paths import SOURCE

EXAMPLES = SOURCE / "examples" / "python"


class Examples(unittest.TestCase):
    def test_each_job_has_one_that_runs(self):
        texts = {p: p.read_text() for p in sorted(EXAMPLES.glob("*.py"))}
        for job in furrow._JOBS:
            self.assertIn(f"furrow.{job}(", "".join(texts.values()))
        for path, text in texts.items():
            with self.subTest(path.stem), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-B", path, folder], capture_output=True,
                                      text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                written = list(pathlib.Path(folder).iterdir())
                self.assertTrue(written and all(w.stat().st_size > 0 for w in written))
                named = set(re.findall(r'folder / "([\w-]+\.\w+)"', text))
                self.assertEqual(named - {w.name for w in written}, set())
                self.assertTrue(done.stdout.strip())


if __name__ == "__main__":
    unittest.main()
