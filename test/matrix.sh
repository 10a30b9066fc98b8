#!/usr/bin/env bash
# Builds the libraries in other ways than CI does - static, without optimisation, by
# clang++ - and tries each: all public headers in two translation units, then the package,
# installed elsewhere, with the examples. About 20 minutes a way on 2 cores.
#   test/matrix.sh [static|debug|clang|static-debug|static-clang ...]   all if none is named
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

options_of() { # NAME: options of CMake, one a line
  case "$1" in
    static) echo -DCMAKE_BUILD_TYPE=Release; echo -DBUILD_SHARED_LIBS=OFF ;;
    debug) echo -DCMAKE_BUILD_TYPE=Debug ;;
    clang) echo -DCMAKE_BUILD_TYPE=Release; echo -DCMAKE_CXX_COMPILER=clang++ ;;
    static-debug) echo -DCMAKE_BUILD_TYPE=Debug; echo -DBUILD_SHARED_LIBS=OFF ;;
    static-clang)
      options_of static
      echo -DCMAKE_CXX_COMPILER=clang++
      ;;
    *)
      echo "matrix.sh: no way is called $1; there are static, debug, clang," \
        "static-debug and static-clang" >&2
      return 2
      ;;
  esac
}

try() { # NAME
  local name=$1 build=build/matrix/$1 options
  mapfile -t options < <(options_of "$name")
  cmake -S . -B "$build" -G Ninja -DPCL6D_BUILD_APPS=OFF "${options[@]}"
  cmake --build "$build" --target test_all_headers
  "$build/test/bin/test_all_headers" --gtest_brief=1
  rm -rf "$build/prefix"
  cmake --install "$build" --prefix "$build/prefix" > /dev/null
  cmake -S share/examples -B "$build/examples" -G Ninja "${options[@]}" \
    -DCMAKE_PREFIX_PATH="$PWD/$build/prefix"
  cmake --build "$build/examples"
  "$build/examples/drop_in_icp"
  echo "matrix: $name is fine"
}

names=("$@")
[ ${#names[@]} -gt 0 ] || names=(static debug clang static-debug static-clang)
for name in "${names[@]}"; do
  options_of "$name" > /dev/null
done
for name in "${names[@]}"; do
  try "$name"
done
