"""Puts the shared library into the wheel, beside the package, together with the oneTBB that it needs.

GRAZE_LIBRARY names an installed libgraze_c.so: `cmake --install` makes it look for oneTBB in its own folder.
"""

import ctypes
import os
import pathlib
import shutil

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

LIBRARY, TBB = "libgraze_c.so.0", "libtbb.so.12"


def installed_library():
    """Returns the path of the library, or ends the build with what is wrong."""
    given = os.environ.get("GRAZE_LIBRARY")
    if not given:
        raise SystemExit("set GRAZE_LIBRARY to the path of an installed libgraze_c.so")
    path = pathlib.Path(given).resolve()
    if not path.is_file():
        raise SystemExit(f"GRAZE_LIBRARY: there is no file {given}")
    return path


def loaded_path(name):
    """Returns the file that the loader takes for a library of this name."""
    ctypes.CDLL(name)
    with open("/proc/self/maps", encoding="utf-8") as maps:
        for line in maps:
            path = pathlib.Path(line.rstrip("\n").partition("/")[1] + line.rstrip("\n").partition("/")[2])
            if path.name.startswith(name):
                return path
    raise SystemExit(f"the loader has no file for {name}")


class BuildWithLibrary(build_py):
    """Copies the libraries into the built package."""

    def run(self):
        super().run()
        path = installed_library()
        folder = pathlib.Path(self.build_lib) / "graze"
        shutil.copyfile(path, folder / LIBRARY)
        text = path.read_bytes()
        if TBB.encode() + b"\0" in text:
            if b"$ORIGIN\0" not in text:
                raise SystemExit(f"{path} does not look for oneTBB in its own folder; install it with cmake --install")
            shutil.copyfile(loaded_path(TBB), folder / TBB)


class WithLibrary(Distribution):
    """Says that the package is of one platform."""

    def has_ext_modules(self):
        return True


class PlatformWheel(bdist_wheel):
    """Names the wheel after the platform alone: its library is of no version of Python."""

    def get_tag(self):
        return "py3", "none", super().get_tag()[2]


setup(distclass=WithLibrary, cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel})
