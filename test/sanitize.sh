#!/usr/bin/env bash
# The lower floors and their tests under the address and undefined-behaviour sanitizers.
# usage: test/sanitize.sh [MODULE ...]     (default: common io search run filters)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
modules=("$@")
[ $# -gt 0 ] || modules=(common io search run filters)
targets=()
for module in "${modules[@]}"; do
  targets+=("test_$module")
done
echo "== sanitizers: ${modules[*]}"
cmake --preset asan --log-level=WARNING
cmake --build build/asan --target "${targets[@]}"
pattern=$(IFS='|'; echo "^(${targets[*]})\\.")
ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
  ctest --test-dir build/asan --output-on-failure -j "$(nproc)" --tests-regex "$pattern"
