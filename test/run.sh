#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests with ctest.
# usage: test/run.sh [--all] [--werror] [ctest options]
#   --all: the slow tests too; --werror: warnings of the compiler are errors
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
filter=(--label-exclude slow)
werror=OFF
while true; do
  case ${1:-} in
    --all) filter=() ;;
    --werror) werror=ON ;;
    *) break ;;
  esac
  shift
done
cd "$root"
echo "== 1/3 dependencies"
cmake/install_dependencies.sh --tests
echo "== 2/3 build"
cmake --preset release -D PCL6D_WERROR=$werror
cmake --build build/release
echo "== 3/3 tests"
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "${filter[@]}" "$@"
