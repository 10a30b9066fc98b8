#!/usr/bin/env bash
# clang-tidy (.clang-tidy) on the sources that differ from origin/main or, where nothing
# does, from those of 24 hours ago: those with the most changed lines first, until the time is
# up. What was not reached is counted, so that a large change can be run again with more.
# usage: test/tidy.sh [FILE.cpp ...]     PCL6D_TIDY_SECONDS: time for it all (default 480)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${PCL6D_TIDY_SECONDS:-480}
folder=build/tidy

changed_sources() { # since: a commit
  git diff --numstat --diff-filter=AM -M "$1" -- 'modules/*.cpp' 'apps/*.cpp' |
    sort -rn | cut -f 3 | sed -E 's/\{.* => (.*)\}/\1/; s/.* => //'
}
files=("$@")
if [ $# -eq 0 ]; then
  since=$(git rev-parse --verify --quiet origin/main || true)
  if [ -z "$since" ] || git diff --quiet "$since"; then
    since=$(git rev-list -1 --before='24 hours ago' HEAD)
  fi
  [ -n "$since" ] || since=$(git rev-list --max-parents=0 HEAD | tail -n 1)
  mapfile -t files < <(changed_sources "$since")
fi
echo "== tidy: ${#files[@]} sources, at most $seconds s"
[ ${#files[@]} -gt 0 ] || exit 0

# clang cannot read what g++ precompiles.
cmake --preset release -B "$folder" -D PCL6D_PRECOMPILED_HEADERS=OFF --log-level=ERROR
log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
export folder log
status=0
printf '%s\0' "${files[@]}" | timeout "$seconds" xargs -0 -n 1 -P 2 bash -c '
  clang-tidy-14 -p "$folder" --quiet --warnings-as-errors="*" "$1" 2>"$log/stderr" &&
    echo "$1" >>"$log/clean" || { echo "$1" >>"$log/faulty"; exit 1; }' _ || status=$?
clean=$(cat "$log/clean" 2>/dev/null | wc -l)
faulty=$(cat "$log/faulty" 2>/dev/null | wc -l)
echo "tidy: $clean clean, $faulty with faults, $((${#files[@]} - clean - faulty)) not reached"
[ "$faulty" -eq 0 ] && { [ "$status" -eq 0 ] || [ "$status" -eq 124 ]; }
