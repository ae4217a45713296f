# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the module with CMake. FURROW_BUILD names a build folder whose module is taken as it is; without, all that it
stands on is built in build/python of the checkout."""
import glob
import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent


def version():
    return re.search(r"project\(furrow VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


class BuildByCMake(build_ext):
    def run(self):
        folder = os.environ.get("FURROW_BUILD", "") or self.build_all()
        modules = glob.glob(os.path.join(folder, "python", "furrow", "_furrow*" + sysconfig_suffix()))
        if not modules:
            raise SystemExit(f"error: {folder} has no module for {sys.executable}: build its target `python`")
        for extension in self.extensions:
            target = self.get_ext_fullpath(extension.name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copy(modules[0], target)

    def build_all(self):
        folder = str(ROOT / "build" / "python")
        configure = ["cmake", "-G", "Ninja", "-S", str(ROOT), "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                     "-DFURROW_COMPONENTS=python", "-DFURROW_PYTHON=ON", "-DFURROW_UNITY=ON",
                     "-DFURROW_BUILD_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"]
        subprocess.run(configure, check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "python", "-j", os.environ.get("FURROW_JOBS", "2")],
                       check=True)
        return folder


def sysconfig_suffix():
    import sysconfig
    return sysconfig.get_config_var("EXT_SUFFIX")


setup(version=version(), ext_modules=[Extension("furrow._furrow", sources=[])],
      cmdclass={"build_ext": BuildByCMake})
