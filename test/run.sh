#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests with ctest.
# usage: test/run.sh [--all] [ctest options]     (--all: the slow tests too)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
filter=(--label-exclude slow)
if [ "${1:-}" = "--all" ]; then
  filter=()
  shift
fi
cd "$root"
echo "== 1/3 dependencies"
cmake/install_dependencies.sh --tests
echo "== 2/3 build"
cmake --preset release
cmake --build build/release
echo "== 3/3 tests"
ctest --test-dir build/release --output-on-failure -j "$(nproc)" "${filter[@]}" "$@"
