#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests with ctest.
# usage: test/run.sh [--all] [--werror] [--part modules|programs] [ctest options]
#   --all: the slow tests too; --werror: warnings of the compiler are errors
#   --part: modules: all but the tests of programs (test/apps); programs: these alone
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
filter=(--label-exclude slow)
werror=OFF
programs=ON
tests=build/release
while true; do
  case ${1:-} in
    --all) filter=() ;;
    --werror) werror=ON ;;
    --part)
      case ${2:-} in
        modules) programs=OFF ;;
        programs) tests=build/release/test/apps ;;
        *) echo "run.sh: error: --part '${2:-}': must be modules or programs" >&2 && exit 2 ;;
      esac
      shift ;;
    *) break ;;
  esac
  shift
done
cd "$root"
echo "== 1/3 dependencies"
cmake/install_dependencies.sh --tests
echo "== 2/3 build"
cmake --preset release -D PCL6D_WERROR=$werror -D PCL6D_BUILD_PROGRAM_TESTS=$programs
cmake --build build/release
echo "== 3/3 tests"
ctest --test-dir $tests --output-on-failure -j "$(nproc)" "${filter[@]}" "$@"
