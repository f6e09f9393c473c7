"""Builds slipcheck._reference with CMake against the installed libraries of Slipcheck.

They are found as CMake finds packages: libslipcheck-dev of Debian, or the prefix of `cmake --install` in the environment variable
CMAKE_PREFIX_PATH. SLIPCHECK_PURE=1 leaves the module out: what runs the program and reads its results needs none.
"""
import os
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class BuildWithCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        build = Path(self.build_temp).resolve() / extension.name
        build.mkdir(parents=True, exist_ok=True)
        configure = ["cmake", "-S", str(Path(__file__).resolve().parent), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release",
                     f"-DPython3_EXECUTABLE={sys.executable}"]
        if "CMAKE_GENERATOR" not in os.environ and not shutil.which("make") and shutil.which("ninja"):
            configure += ["-G", "Ninja"]
        try:
            subprocess.run(configure, check=True)
            subprocess.run(["cmake", "--build", str(build)], check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            raise SystemExit(f"slipcheck: the module slipcheck._reference cannot be built ({error}): it needs CMake, pybind11 and "
                             "Slipcheck's libraries (docs/install.md); SLIPCHECK_PURE=1 leaves it out") from error
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(next((build / "slipcheck").glob("_reference*.so"))), str(target))


is_pure = os.environ.get("SLIPCHECK_PURE") == "1"
setup(ext_modules=[] if is_pure else [Extension("slipcheck._reference", [])],
      cmdclass={"build_ext": BuildWithCMake})
