#!/usr/bin/env bash
# Tests under a sanitizer: address and undefined behaviour (casts from floats too), or with
# --thread races between threads. The first fault ends a program.
# usage: test/sanitize.sh [--thread|--libraries] [--seconds N] [MODULE ...|all]
#   --thread, default: the modules whose code runs in several threads
#   --libraries: only the libraries are built so, a tenth of the work, and run by the tests and
#     programs that build/release holds; what these compile of templates and leaks stay unseen
#   --seconds N: module by module, the first one in any case; after N seconds building ends and
#     no test is begun, and what was covered is counted
#   all: every test but the slow ones and those of the installed package; hours on 2 cores
# Exit code 1: a test failed, or none was run.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=asan tests=build/asan seconds=
modules=(common io run)
while [[ ${1:-} = --* ]]; do
  case $1 in
    --thread)
      preset=tsan tests=build/tsan
      modules=(common search filters registration global_registration plane_segmentation
        verification moving_objects graph_relaxation scanner scene_interpretation localisation
        object_localization semantic_map simulation slam6d benchmarking)
      ;;
    --libraries) tests=build/release ;;
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    *) sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
  esac
  shift
done
[ $# -eq 0 ] || modules=("$@")
[ "$preset $tests" != "tsan build/release" ] ||
  { echo "sanitize.sh: --thread takes no --libraries: races are seen in whole programs alone" >&2; exit 2; }
echo "== sanitizers, preset $preset: ${modules[*]}"
cmake --preset "$preset" --log-level=WARNING
excluded='^(install|house)\.'
[ "$tests" != build/release ] || excluded+='|InABrowser' # which hangs with what is preloaded
leaks=1
[ "$tests" != build/release ] || leaks=0 # of every program that a test starts, ours or not
# EIGEN_MALLOC_ALREADY_ALIGNED (preset): Eigen aligns memory in its own way where it sees the
# sanitizer, and PCL's libraries, which were built without, could not free it.
# alloc_dealloc_mismatch: PCL's libraries, built for C++14, take clouds from malloc by an
# operator of the class, which C++17 has no more: a cloud of theirs is freed by delete.
# Faults of other people's libraries, each with its reason. All this is for the build as well,
# which runs each test program once for the names of its tests.
suppressions=$PWD/test/suppressions
export ASAN_OPTIONS=detect_stack_use_after_return=1:alloc_dealloc_mismatch=0:detect_leaks=$leaks
export LSAN_OPTIONS=suppressions=$suppressions/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$suppressions/threads.txt
loaded=()
[ "$tests" != build/release ] || loaded=("LD_LIBRARY_PATH=$PWD/build/$preset/lib"
  "LD_PRELOAD=$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libubsan.so)")

build() { # SECONDS [MODULE ...]: their tests; none: all. 124: the time is up; 0 s: no limit
  [ "$tests" != build/release ] || timeout "$1" ninja -C "build/$preset" modules/all || return
  timeout "$1" ninja -C "$tests" "${@:2}"
}

selection=()
select_tests() { # [MODULE ...]: those of the modules, else all
  selection=(--label-exclude slow --exclude-regex "$excluded")
  [ $# -eq 0 ] || selection+=(--tests-regex "^test_($(IFS='|'; echo "$*"))\\.")
}

run() { # ctest options
  env "${loaded[@]}" ctest --test-dir "$tests" --output-on-failure --no-tests=error \
    -j "$(nproc)" "$@"
}

if [ -z "$seconds" ]; then
  [ "${modules[*]}" != all ] || modules=()
  build 0 "${modules[@]/#/test_}"
  select_tests "${modules[@]}"
  run "${selection[@]}"
  exit
fi

numbers_of() { # FOLDER: the tests of the selection there, if it is built
  [ ! -f "$1/CTestTestfile.cmake" ] || ctest --test-dir "$1" --show-only "${selection[@]}" |
    sed -n 's/^ *Test *#\([0-9]*\): .*/\1/p'
}
covered=0 known=0 status=0 not_built=()
for module in "${modules[@]}"; do
  of_module=("$module")
  [ "$module" != all ] || of_module=()
  select_tests "${of_module[@]}"
  left=0 code=0
  [ $covered = 0 ] || left=$((SECONDS < seconds ? seconds - SECONDS : 1))
  build $left "${of_module[@]/#/test_}" || code=$?
  if [ $code = 124 ]; then
    not_built+=("$module")
    known=$((known + $(numbers_of build/release | wc -l)))
    continue
  fi
  [ $code = 0 ] || exit $code
  mapfile -t numbers < <(numbers_of "$tests")
  known=$((known + ${#numbers[@]}))
  # By the dozen, so that little is begun late; the first dozen of all in any case. Numbers
  # without a selection: with one, ctest would count anew.
  for ((i = 0; i < ${#numbers[@]} && (covered == 0 || SECONDS < seconds); i += 12)); do
    dozen=("${numbers[@]:i:12}")
    run --tests-information "0,0,0,$(IFS=,; echo "${dozen[*]}")" || status=1
    covered=$((covered + ${#dozen[@]}))
  done
done
echo "sanitizers: $covered of $known tests${not_built[*]:+; not built: ${not_built[*]}}"
[ $status = 0 ] && [ $covered -gt 0 ]
