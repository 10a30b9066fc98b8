#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# make_man_pages.sh FOLDER PROGRAM ... writes man pages from what the programs say to
# --help: FOLDER/NAME.1, and FOLDER/NAME-JOB.1 for each job of a program that has several.
set -eu
folder=$1
shift
here=$(dirname "$0")
export COLUMNS=10000

page() { # program, job or "", see also
  name=$(basename "$1")${2:+ $2}
  file=$folder/$(echo "$name" | tr ' ' -).1
  # The job stays unquoted: without one it is no argument.
  "$1" $2 --help >"$file.help"
  awk -f "$here/help_to_man.awk" -v name="$name" -v version="$version" -v also="$3" \
    "$file.help" >"$file"
  rm "$file.help"
}

jobs_of() { # program
  "$1" --help | awk '/^  [a-z][a-z-]*( |$)/ { jobs = jobs " " $1 }
                     /--help tells the options/ { print jobs }'
}

mkdir -p "$folder"
rm -f "$folder"/*.1
for program in "$@"; do
  base=$(basename "$program")
  version=$("$program" --version)
  version=${version#pcl6d }
  others=
  for other in "$@"; do
    [ "$other" = "$program" ] || others="$others${others:+, }$(basename "$other")(1)"
  done
  jobs=$(jobs_of "$program")
  for job in $jobs; do
    page "$program" "$job" "$base(1)"
    others="$base-$job(1)${others:+, }$others"
  done
  page "$program" "" "$others"
done
