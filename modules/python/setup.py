# SPDX-License-Identifier: BSD-3-Clause
"""Builds the extension module with the CMake of the suite, which stands two folders above.

All libraries of the suite become part of the extension; those of the system (PCL, PROJ, ...) must
be installed (cmake/install_dependencies.sh). What is compiled is kept in build/python of the
clone, or in the folder PCL6D_BUILD_DIR; CMAKE_BUILD_PARALLEL_LEVEL says how many compilers run.
"""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import setuptools
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]


class CMakeBuild(build_ext):
    def run(self):
        build = os.environ.get("PCL6D_BUILD_DIR", str(ROOT / "build" / "python"))
        target = pathlib.Path(self.get_ext_fullpath("pcl6d._native")).parent.resolve()
        options = {
            "CMAKE_BUILD_TYPE": "Release",
            "BUILD_SHARED_LIBS": "OFF",
            "PCL6D_BUILD_APPS": "OFF",
            "PCL6D_BUILD_TESTS": "OFF",
            "PCL6D_BUILD_PYTHON": "ON",
            "PCL6D_MPI": "OFF",
            "PCL6D_PYTHON_DIR": ".",
            "Python3_EXECUTABLE": sys.executable,
        }
        if importlib.util.find_spec("pybind11"):  # else CMake looks for the system's
            options["pybind11_DIR"] = importlib.import_module("pybind11").get_cmake_dir()
        words = [f"-D{name}={value}" for name, value in options.items()]
        subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, *words], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "pcl6d_python"], check=True)
        subprocess.run(
            ["cmake", "--install", build, "--component", "python", "--prefix", target.parent],
            check=True,
        )


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(pcl6d VERSION (\S+)", text)[1]


setuptools.setup(
    version=version(),
    ext_modules=[setuptools.Extension("pcl6d._native", [])],
    cmdclass={"build_ext": CMakeBuild},
)
