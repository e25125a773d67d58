# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""Puts the shared library, built by CMake, into a wheel that serves every Python 3.

CREASE_LIBRARY names a library that is already built; CMAKE_ARGS are handed to CMake.
"""

import os
import shlex
import shutil
import subprocess
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

ROOT = Path(__file__).resolve().parent
FOLDER = ROOT / "build-python" / "cmake"


def built_library():
    """The shared library: the one that is named, or a new one."""
    named = os.environ.get("CREASE_LIBRARY")
    if named:
        return Path(named)
    subprocess.run(["cmake", "-S", ROOT, "-B", FOLDER, "-DCREASE_TESTS=OFF",
                    *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
    subprocess.run(["cmake", "--build", FOLDER, "--target", "crease-shared", "--parallel",
                    str(os.cpu_count() or 1)], check=True)
    return FOLDER / "libcrease.so"


class BuildWithLibrary(build_py):
    """The package and its library."""

    def run(self):
        super().run()
        if not self.editable_mode:
            target = Path(self.build_lib) / "crease" / "libcrease.so"
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(built_library(), target)


class WheelForAnyPython(bdist_wheel):
    """For this platform, as the library is; for every Python 3, as ctypes is."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


setup(version=(ROOT / "VERSION").read_text().split()[0], distclass=WithLibrary,
      cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": WheelForAnyPython})
