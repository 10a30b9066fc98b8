#!/usr/bin/env bash
# Installs what is missing, builds everything and runs the tests with ctest.
# usage: test/run.sh [--all] [--werror] [--part modules|programs] [--only build|tests]
#                    [ctest options]
#   --all: the slow tests too; --werror: warnings of the compiler are errors
#   --part: modules: all but the tests of programs (test/apps), which are not even built;
#     programs: these alone
#   --only build: no tests; --only tests: of what has been built
#   ctest options: for example -R test_io, -j 2, --rerun-failed (ctest --help)
set -euo pipefail

fail() {
  echo "run.sh: error: $1" >&2
  exit 2
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
filter=(--label-exclude slow)
werror=OFF
programs=ON
part=all
only=all
while true; do
  case ${1:-} in
    --all) filter=() ;;
    --werror) werror=ON ;;
    --part)
      part=${2:-}
      case $part in
        modules) programs=OFF ;;
        programs) ;;
        *) fail "--part '$part': must be modules or programs" ;;
      esac
      shift ;;
    --only)
      only=${2:-}
      case $only in
        build | tests) ;;
        *) fail "--only '$only': must be build or tests" ;;
      esac
      shift ;;
    -h | --help)
      sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
      exit 0 ;;
    *) break ;;
  esac
  shift
done
# ctest ignores an option that it does not know: a misspelled one would build and test everything.
for option in "$@"; do
  case $option in
    --all | --werror | --part | --only) fail "$option must stand before the options of ctest" ;;
    --*)
      command -v ctest > /dev/null || break # step 1 installs it
      name=${option%%=*}
      grep -qE -- "$name([ =,]|\$)" <(ctest --help 2>/dev/null) ||
        fail "unknown option $name (test/run.sh --help)" ;;
  esac
done
cd "$root"
if [ "$only" != tests ]; then
  echo "== 1/3 dependencies"
  cmake/install_dependencies.sh --tests
  echo "== 2/3 build"
  cmake --preset release -D PCL6D_WERROR=$werror -D PCL6D_BUILD_PROGRAM_TESTS=$programs
  cmake --build build/release
fi
[ "$only" != build ] || exit 0
[ -f build/release/CTestTestfile.cmake ] ||
  fail "nothing is built in $root/build/release: run test/run.sh without --only tests"

tests=build/release
of_programs=build/release/test/apps
if [ "$part" = programs ]; then
  tests=$of_programs
elif [ "$part" = modules ] && [ -f $of_programs/CTestTestfile.cmake ]; then
  # Both are built: those of the programs are left out by the names of their test programs.
  names=$(ctest --test-dir $of_programs --show-only |
    sed -n 's/^ *Test *#[0-9]*: \([^.]*\)\..*/\1/p' | sort -u | paste -sd '|')
  filter+=(--exclude-regex "^($names)\\.")
fi
echo "== 3/3 tests"
# A test that hangs is named before the time of the whole step is up.
ctest --test-dir $tests --output-on-failure --no-tests=error --timeout 600 -j "$(nproc)" "${filter[@]}" "$@"
