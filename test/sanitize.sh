#!/usr/bin/env bash
# Tests under a sanitizer: address and undefined behaviour (casts from floats too), or with
# --thread races between threads. The first fault ends a program.
# usage: test/sanitize.sh [--thread|--libraries] [MODULE ...|all]
#   --thread, default: the modules whose code runs in several threads
#   --libraries: only the libraries are built so, a tenth of the work, and run by the tests and
#     programs that build/release holds; what these compile of templates and leaks stay unseen
#   all: every test but the slow ones and those of the installed package; hours on 2 cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=asan tests=build/asan
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
    *) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
  esac
  shift
done
[ $# -eq 0 ] || modules=("$@")
[ "$preset $tests" != "tsan build/release" ] ||
  { echo "sanitize.sh: --thread takes no --libraries: races are seen in whole programs alone" >&2; exit 2; }
echo "== sanitizers, preset $preset: ${modules[*]}"
cmake --preset "$preset" --log-level=WARNING
targets=()
excluded='^(install|house)\.'
[ "$tests" != build/release ] || excluded+='|InABrowser' # which hangs with what is preloaded
selection=(--label-exclude slow)
if [ "${modules[*]}" != all ]; then
  targets=("${modules[@]/#/test_}")
  selection=(--tests-regex "$(IFS='|'; echo "^(${targets[*]})\\.")")
fi
leaks=1
[ "$tests" != build/release ] || leaks=0 # of every program that a test starts, ours or not
# EIGEN_MALLOC_ALREADY_ALIGNED (preset): Eigen aligns memory in its own way where it sees the
# sanitizer, and PCL's libraries, which were built without, could not free it.
# alloc_dealloc_mismatch: PCL's libraries, built for C++14, take clouds from malloc by an
# operator of the class, which C++17 has no more: a cloud of theirs is freed by delete. And the
# programs have an operator new of their own, but for the one that does not throw.
# Faults of other people's libraries, each with its reason. All this is for the build as well,
# which runs each test program once for the names of its tests.
suppressions=$PWD/test/suppressions
export ASAN_OPTIONS=detect_stack_use_after_return=1:alloc_dealloc_mismatch=0:detect_leaks=$leaks
export LSAN_OPTIONS=suppressions=$suppressions/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$suppressions/threads.txt
if [ "$tests" = build/release ]; then
  ninja -C "build/$preset" modules/all
  ninja -C "$tests" "${targets[@]}"
  loaded=("LD_LIBRARY_PATH=$PWD/build/$preset/lib"
    "LD_PRELOAD=$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libubsan.so)")
else
  ninja -C "build/$preset" "${targets[@]}"
  loaded=()
fi
env "${loaded[@]}" ctest --test-dir "$tests" --output-on-failure -j "$(nproc)" \
  "${selection[@]}" --exclude-regex "$excluded"
