#!/usr/bin/env bash
# Checks that test/run.sh answers --help and wrong options at once, in place of building everything.
# usage: run_options.sh TREE
set -euo pipefail
tree=$1
faults=0

# What the script answers to options: exit code, and a part of the text.
expect() { # code text options...
  local code=0 text
  text=$(timeout 20 "$tree/test/run.sh" "${@:3}" 2>&1) || code=$?
  [ "$code" = "$1" ] && grep -qF -- "$2" <<<"$text" && return
  echo "run.sh ${*:3}: exit code $code, not $1, or without '$2':"
  head -3 <<<"$text"
  faults=1
}

expect 0 "usage: test/run.sh" --help
expect 0 "ctest options" -h
expect 2 "unknown option --onyl" --onyl tests
expect 2 "unknown option --rerun-faild" --only tests --rerun-faild
expect 2 "--part '': must be modules or programs" --part
expect 2 "--only 'test': must be build or tests" --only test
expect 2 "--only must stand before the options of ctest" -R Icp --only tests

# A clone in which nothing is built yet.
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
mkdir "$clone/test"
cp "$tree/test/run.sh" "$clone/test"
tree=$clone
expect 2 "nothing is built" --only tests
expect 2 "nothing is built" --only tests --part programs --exclude-regex Icp
exit $faults
