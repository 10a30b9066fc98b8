#!/usr/bin/env bash
# Tests under a sanitizer: address and undefined behaviour (casts from floats too), or with
# --thread races between threads. The first fault ends a program.
# usage: test/sanitize.sh [--thread] [MODULE ...|all]   (default: common io run)
#   --thread, default: the modules whose code runs in several threads
#   all: every test but the slow ones and those of the installed package; hours on 2 cores
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=asan
modules=(common io run)
if [ "${1:-}" = --thread ]; then
  preset=tsan
  modules=(common search filters registration plane_segmentation verification graph_relaxation
    scene_interpretation localisation slam6d)
  shift
fi
[ $# -eq 0 ] || modules=("$@")
echo "== sanitizers, preset $preset: ${modules[*]}"
cmake --preset "$preset" --log-level=WARNING
if [ "${modules[*]}" = all ]; then
  cmake --build "build/$preset"
  selection=(--label-exclude slow --exclude-regex '^(install|house)\.')
else
  targets=()
  for module in "${modules[@]}"; do
    targets+=("test_$module")
  done
  cmake --build "build/$preset" --target "${targets[@]}"
  selection=(--tests-regex "$(IFS='|'; echo "^(${targets[*]})\\.")")
fi
# Faults of other people's libraries, each with its reason.
suppressions=$PWD/test/suppressions
export ASAN_OPTIONS=detect_stack_use_after_return=1
export LSAN_OPTIONS=suppressions=$suppressions/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$suppressions/threads.txt
ctest --test-dir "build/$preset" --output-on-failure -j "$(nproc)" "${selection[@]}"
