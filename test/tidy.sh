#!/usr/bin/env bash
# clang-tidy (.clang-tidy) on the sources that differ from origin/main or, where nothing
# does, from those of 24 hours ago: those with the most changed lines first. After N seconds no
# source is begun any more, and what was not reached is counted, so that a large change can be
# run again with more. Exit code 1: a source has faults, or none was reached.
# usage: test/tidy.sh [--seconds N] [FILE.cpp ...]     (default: 480 s)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=480
while [[ ${1:-} = -* ]]; do
  case $1 in
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    *) sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
  esac
  shift
done
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

# clang cannot read what g++ precompiles, and needs the command of each source by itself.
cmake --preset release -B "$folder" -D PCL6D_PRECOMPILED_HEADERS=OFF \
  -D PCL6D_UNITY_BUILD=OFF --log-level=ERROR
log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
end=$(($(date +%s) + seconds))
export folder log end
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P 2 bash -c '
  [ "$(date +%s)" -lt "$end" ] || exit 0
  if clang-tidy-14 -p "$folder" --quiet --warnings-as-errors="*" "$1" 2>"$log/stderr.$$"; then
    echo "$1" >>"$log/clean"
  else
    grep -v "warnings generated\|^Suppressed\|^Use -header" "$log/stderr.$$" | tail -n 5
    echo "$1" >>"$log/faulty"
  fi' _
touch "$log/clean" "$log/faulty"
clean=$(wc -l <"$log/clean")
faulty=$(wc -l <"$log/faulty")
echo "tidy: $clean clean, $faulty with faults, $((${#files[@]} - clean - faulty)) not reached"
[ "$faulty" -eq 0 ] && [ "$clean" -gt 0 ]
