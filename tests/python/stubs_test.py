# SPDX-License-Identifier: GPL-3.0-or-later
"""The stubs are those that the keywords make, and type checkers take them."""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

import furrow
import make_stubs
from paths import SOURCE


class Stubs(unittest.TestCase):
    def test_the_stubs_are_made_of_the_keywords(self):
        made = make_stubs.text()
        kept = (SOURCE / "python" / "src" / "furrow" / "__init__.pyi").read_text()
        self.assertEqual(made, kept, "make them anew: " + make_stubs.COMMAND)

    def test_mypy_takes_the_stubs_and_the_examples(self):
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as cache:
            for path in sorted((SOURCE / "examples" / "python").glob("*.py")):
                self.assertIn("def main", path.read_text(), path)
            done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache,
                                   str(SOURCE / "python" / "src" / "furrow" / "__init__.pyi"),
                                   str(SOURCE / "examples" / "python")], capture_output=True, text=True,
                                  env={**os.environ, "MYPYPATH": str(SOURCE / "python" / "src")})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stubs_name_all_that_there_is(self):
        text = make_stubs.text()
        for name in dir(furrow):
            if not name.startswith("_"):
                self.assertRegex(text, rf"(?m)^(def|class) {name}\b")


if __name__ == "__main__":
    unittest.main()
