#!/usr/bin/env bash
# Breaks inputs of all kinds in thousands of ways, runs the programs on them and lists what
# crashes, hangs, fills memory, speaks in riddles, leaves litter or calls a failure a success.
# usage: test/faults/run.sh [--sample N] [--seconds N] [--seed S] [--jobs N] [--keep DIR] [PATTERN]
#   all cases: about 20 minutes on 2 cores. --sample N: so many, spread over all. PATTERN: a
#   regular expression of names of cases (--list prints them). --keep DIR: inputs, command
#   and words of each finding. --seconds N: no case is begun later; the last line tells how
#   many were. Exit code 1: there are findings; 2: no case was run. Build: pcl6d_faults
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tool=$root/build/${PCL6D_PRESET:-release}/test/bin/pcl6d_faults
if [ ! -x "$tool" ]; then
  echo "run.sh: no $tool: cmake --build build/release --target pcl6d_faults" >&2
  exit 2
fi
jobs=(--jobs "$(nproc)")
for word in "$@"; do
  case $word in --jobs | --jobs=*) jobs=() ;; esac
done
exec "$tool" "${jobs[@]}" "$@"
