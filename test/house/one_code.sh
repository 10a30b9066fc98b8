#!/usr/bin/env bash
# No two libraries show one symbol of the suite with different code: of the copies that the
# linker would merge (templates, inline functions, vtables), all have one size.
# usage: one_code.sh LIBRARY ...
set -euo pipefail
for library in "$@"; do
  nm --dynamic --defined-only --print-size "$library" | awk -v library="$(basename "$library")" '
    NF == 4 && $4 ~ /5pcl6d/ { print $4, $2, $3, library }'
done | sort | awk '
  { ++count }
  $1 == symbol && $2 != size {
    "c++filt " $1 | getline name
    print name ": 0x" size " bytes in " library ", 0x" $2 " in " $4
    found = 1
  }
  { symbol = $1; size = $2; library = $4 }
  END { print count " symbols"; exit found || count == 0 }'
