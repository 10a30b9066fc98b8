#!/usr/bin/env bash
# No two libraries show one class of the suite with different code: all copies of its vtable
# and type information, which the linker merges, have one size. (Copies of functions may
# differ in size, as they are inlined differently; one_name.sh sees to their types.)
# usage: one_code.sh LIBRARY ...
set -euo pipefail
for library in "$@"; do
  nm --dynamic --defined-only --print-size --demangle "$library" |
    awk -v library="$(basename "$library")" '
      $4 ~ /^(vtable|typeinfo)$/ && /pcl6d::/ {
        size = $2
        $1 = $2 = $3 = ""
        print $0 "\t" size "\t" library
      }'
done | sort | awk -F '\t' '
  { ++count }
  $1 == symbol && $2 != size {
    print symbol ": 0x" size " bytes in " library ", 0x" $2 " in " $3
    found = 1
  }
  { symbol = $1; size = $2; library = $3 }
  END { print count " symbols"; exit found || count == 0 }'
