# SPDX-License-Identifier: GPL-3.0-or-later
"""`pip install` without a network, into an environment of its own; of the module that is built already."""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest

from paths import SOURCE

USE = """
import furrow, importlib.metadata, pathlib
assert importlib.metadata.version("furrow") == furrow.__version__
folder = pathlib.Path(furrow.__file__).parent
assert str(folder).startswith({folder!r}), folder
assert (folder / "py.typed").exists() and (folder / "__init__.pyi").exists()
mesh = furrow.subdivide({mesh!r}, linear=1).mesh
print(len(mesh.F))
"""


class Pip(unittest.TestCase):
    def test_it_installs_what_runs(self):
        if not os.environ.get("FURROW_BUILD"):
            self.skipTest("FURROW_BUILD names no build folder")
        for needed in ("setuptools", "wheel", "pip"):
            if importlib.util.find_spec(needed) is None:
                self.skipTest(needed + " is not installed")
        with tempfile.TemporaryDirectory() as folder:
            environment = os.path.join(folder, "venv")
            try:
                subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", environment], check=True,
                               capture_output=True)
            except subprocess.CalledProcessError as error:
                self.skipTest("no venv here: " + error.stdout.decode()[:200])
            python = os.path.join(environment, "bin", "python")
            # pip builds beside the sources: of a copy, so that the checkout stays as it is.
            copy = os.path.join(folder, "checkout")
            os.mkdir(copy)
            subprocess.run(["cp", "-r", str(SOURCE / "python"), str(SOURCE / "CMakeLists.txt"), copy], check=True)
            done = subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-build-isolation",
                                   "--disable-pip-version-check", os.path.join(copy, "python")],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            alone = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
            used = subprocess.run([python, "-c", USE.format(folder=environment,
                                                            mesh=str(SOURCE / "meshes" / "skirt.obj"))],
                                  capture_output=True, text=True, env=alone, cwd=folder)
            self.assertEqual(used.returncode, 0, used.stderr)
            self.assertEqual(int(used.stdout) % 4, 0)


if __name__ == "__main__":
    unittest.main()
