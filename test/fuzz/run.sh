#!/usr/bin/env bash
# Feeds broken files to every reader: clang's libFuzzer with the address and
# undefined-behaviour sanitizers. Fails if any target has a finding, or none was run.
# usage: test/fuzz/run.sh [--each N | --seconds N] [--jobs N] [--list] [TARGET ...]
#   --each N: seconds for each target (default: 20); --seconds N: for it all, the build too,
#   which is finished in any case: what is left is shared out, at least a second to each
# What it learns stays in build/fuzz/corpus; inputs that are findings go to
# build/fuzz/findings/TARGET. One such input again: build/fuzz/bin/fuzz_TARGET FILE
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

run_one() { # TARGET SECONDS: prints one line, and the end of the log of a finding
  local target=$1 seconds=$2 log=build/fuzz/findings/$1.log findings=0 size units edges
  size=$(sed -n "s/^ *X($target, k[A-Za-z]*, \([0-9]*\)).*/\1/p" test/fuzz/targets.h)
  rm -rf "build/fuzz/findings/$target"
  mkdir -p "build/fuzz/corpus/$target" "build/fuzz/findings/$target"
  if ! ASAN_OPTIONS=quarantine_size_mb=16 UBSAN_OPTIONS=print_stacktrace=1 \
    "build/fuzz/bin/fuzz_$target" -max_total_time="$seconds" -max_len="$size" \
    -rss_limit_mb=600 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/findings/$target/" \
    "build/fuzz/corpus/$target" "test/fuzz/corpus/$target" >"$log" 2>&1; then
    findings=1
  fi
  units=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
  edges=$(sed -n 's/^#.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
  printf '%-20s %12s executions %8s edges %3s findings\n' \
    "$target" "${units:-0}" "${edges:-0}" "$findings"
  [ "$findings" = 0 ] || { grep -v '^#' "$log" | tail -n 40; return 1; }
}
if [ "${1:-}" = --one ]; then
  run_one "$2" "$3"
  exit
fi

each=20 seconds=
jobs=$(nproc)
mapfile -t all < <(sed -n 's/^ *X(\([a-z0-9_]*\),.*/\1/p' test/fuzz/targets.h)
targets=()
while [ $# -gt 0 ]; do
  case $1 in
    --each) each=${2:?--each needs a number}; shift ;;
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    --jobs) jobs=${2:?--jobs needs a number}; shift ;;
    --list) printf '%s\n' "${all[@]}"; exit ;;
    -*) echo "usage: $0 [--each N | --seconds N] [--jobs N] [--list] [TARGET ...]" >&2; exit 2 ;;
    *)
      printf '%s\n' "${all[@]}" | grep -qx -- "$1" ||
        { echo "run.sh: no target is called $1; --list tells which there are" >&2; exit 2; }
      targets+=("$1")
      ;;
  esac
  shift
done
[ ${#targets[@]} -gt 0 ] || targets=("${all[@]}")

echo "== fuzzers: ${#targets[@]} targets, ${seconds:-$each} s ${seconds:+in all}"
cmake --preset fuzz --log-level=WARNING
cmake --build build/fuzz --target fuzzers
if [ -n "$seconds" ]; then
  rounds=$(((${#targets[@]} + jobs - 1) / jobs))
  each=$(((seconds - SECONDS) / rounds))
  [ $each -ge 1 ] || each=1
fi
TMPDIR=$(mktemp -d /dev/shm/pcl6d_fuzz.XXXXXX) # input files in memory
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
mkdir -p build/fuzz/findings
log=$TMPDIR/table
status=0
printf '%s\n' "${targets[@]}" |
  xargs -P "$jobs" -I{} test/fuzz/run.sh --one {} "$each" | tee "$log" || status=1
# A target that executed nothing has covered nothing, whatever it exits with.
covered=$(grep -cE '^[a-z0-9_]+ +[1-9][0-9]* executions ' "$log" || true)
echo "fuzzers: $covered of ${#targets[@]} targets, $each s each"
if [ $status != 0 ]; then
  echo "findings: build/fuzz/findings" >&2
elif [ "$covered" = 0 ]; then
  echo "run.sh: nothing was executed" >&2
  status=1
fi
exit $status
