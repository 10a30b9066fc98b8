#!/usr/bin/env bash
# Installs what the suite needs to build, test and run, on Debian and Ubuntu. Does nothing
# where everything is there. On another system it lists the packages and exits with 1.
# usage: cmake/install_dependencies.sh [--tests] [--checks]
#   --tests: also what only some tests need, which skip without it: a browser, npm and rosbag,
#     and what the Python package is built and tested with
#   --checks: also the checkers of sources, in the version that the sources follow, the
#     compiler of the fuzzers, and what makes and checks Debian packages
set -euo pipefail

# Per line: the Debian package, then a file or program that it gives. A package is only
# installed if what it gives is missing, so that a hand-made installation is respected.
needs=(
  "g++ g++"
  "cmake cmake"
  "ninja-build ninja"
  "ccache ccache"
  "xvfb Xvfb"
  "libceres-dev /usr/include/ceres/ceres.h"
  "libboost-all-dev /usr/include/boost/process.hpp"
  "libeigen3-dev /usr/include/eigen3/Eigen/Core"
  "libbz2-dev /usr/include/bzlib.h"
  "libproj-dev /usr/include/proj.h"
  "liblz4-dev /usr/include/lz4frame.h"
  "liboctomap-dev /usr/include/octomap/OcTree.h"
  "libgdal-dev /usr/include/gdal/gdal.h"
  "libsqlite3-dev /usr/include/sqlite3.h"
  "libzstd-dev /usr/include/zstd.h"
  "libexpat1-dev /usr/include/expat.h"
  "libembree-dev /usr/include/embree3/rtcore.h"
  "libflann-dev /usr/include/flann/flann.hpp"
  "libgtest-dev /usr/include/gtest/gtest.h"
  "libbenchmark-dev /usr/include/benchmark/benchmark.h"
  "libopenmpi-dev mpicc"
  "libopencv-dev /usr/include/opencv4/opencv2/calib3d.hpp"
  "libpcl-dev /usr/include/pcl-*/pcl/point_cloud.h"
  "libvtk9-dev /usr/include/vtk-9*/vtkVersion.h"
  "libx11-dev /usr/include/X11/Xlib.h"
  "zlib1g-dev /usr/include/zlib.h"
  "openmpi-bin mpirun"
  "nlohmann-json3-dev /usr/include/nlohmann/json.hpp"
)

# What only tests need: the report is opened in a browser, and made again by npm; bags are
# written by an independent program, maps are read by such ones; files are compared with their JSON Schemas; the site is made. The Python package is built where
# Python, pybind11 and numpy are found.
needs_of_tests=(
  "chromium chromium"
  "doxygen doxygen"
  "furo /usr/lib/python3/dist-packages/furo/__init__.py"
  "python3-myst-parser /usr/lib/python3/dist-packages/myst_parser/__init__.py"
  "python3-sphinx sphinx-build"
  "nodejs node"
  "npm npm"
  "python3-dev /usr/include/python3.*/Python.h"
  "pybind11-dev /usr/include/pybind11/pybind11.h"
  "python3-numpy /usr/lib/python3/dist-packages/numpy/__init__.py"
  "python3-jsonschema /usr/lib/python3/dist-packages/jsonschema/__init__.py"
  "python3-pytest /usr/lib/python3/dist-packages/pytest/__init__.py"
  "mypy mypy"
  "python3-rosbag /usr/lib/python3/dist-packages/rosbag/__init__.py"
  "python3-roslz4 /usr/lib/python3/dist-packages/roslz4/__init__.py"
  "python3-nav-msgs /usr/lib/python3/dist-packages/nav_msgs/__init__.py"
  "python3-sensor-msgs /usr/lib/python3/dist-packages/sensor_msgs/__init__.py"
  "octomap-tools bt2vrml"
  "pkg-config pkg-config"
  "gdal-bin gdalinfo"
)

needs_of_checks=(
  "clang-format-14 clang-format-14"
  "clang-tidy-14 clang-tidy-14"
  "chrpath chrpath"
  "debhelper dh"
  "dh-python dh_python3"
  "lintian lintian"
  "time /usr/bin/time"
  "clang clang++"
  "libclang-rt-14-dev /usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-x86_64.a"
)
for option in "$@"; do
  case $option in
    --tests) tests=yes ;;
    --checks) needs+=("${needs_of_checks[@]}") ;;
    *) echo "error: unknown option $option (usage: $0 [--tests] [--checks])" >&2; exit 2 ;;
  esac
done

given() { # what: a program's name, or a file pattern with an absolute path
  case $1 in
    /*) compgen -G "$1" >/dev/null ;;
    *) command -v "$1" >/dev/null ;;
  esac
}

# Prints the packages whose file or program is missing.
missing_of() {
  local need package what
  for need in "$@"; do
    read -r package what <<<"$need"
    given "$what" || printf '%s ' "$package"
  done
}

missing=$(missing_of "${needs[@]}")
missing_of_tests=""
if [ "${tests:-}" = yes ]; then
  missing_of_tests=$(missing_of "${needs_of_tests[@]}")
fi
if [ -z "$missing$missing_of_tests" ]; then
  echo "dependencies: all there"
  exit 0
fi

if ! command -v apt-get >/dev/null; then
  echo "error: no apt-get here. Please install, under your system's names: $missing$missing_of_tests" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "error: neither root nor sudo. Please install as root: $missing$missing_of_tests" >&2
    exit 1
  fi
  as_root=(sudo)
fi
install() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "$@"
}
echo "dependencies: installing $missing$missing_of_tests"
"${as_root[@]}" apt-get update -q
# Package names hold no spaces.
# shellcheck disable=SC2086
[ -z "$missing" ] || install $missing
for package in $missing_of_tests; do
  install "$package" || echo "warning: no $package; tests that need it will be skipped" >&2
done
