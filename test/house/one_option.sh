#!/usr/bin/env bash
# Each option of pcl_slam6d is named once in the sources: in its row of the table. Prints the
# options that have no such place, or several.
# usage: one_option.sh ROOT [OTHER_MEANINGS]
#   ROOT            of the sources; its share/doc/options.md lists the options
#   OTHER_MEANINGS  lines `word file meaning`: literals that are no option
set -euo pipefail
cd "$1"
others=${2:-/dev/null}
mapfile -t names < <(sed -nE 's/^\| `--([a-z0-9-]+)`.*/\1/p' share/doc/options.md)
mapfile -t files < <(
  find apps/common apps/slam6d apps/pcl_slam6d.cpp modules/common modules/filters/src/scan_parameters.cpp \
    modules/run modules/slam6d -type f \( -name '*.h' -o -name '*.cpp' \) 2>/dev/null | sort)
found=0
for name in "${names[@]}"; do
  # "name", "name,n", "name OPERAND", and "--name" alone; a text that mentions --name is none,
  # and so is a comment.
  literal="\"(--)?$name(,[a-z])?( [A-Z][^\"]*)?\""
  places=$(grep -HnE "$literal" "${files[@]}" |
    sed -E 's,^([^:]*:[0-9]+:) *(//|/?\*).*,\1,; s, //.*,,' | grep -E "$literal" |
    cut -d: -f1,2 || true)
  while read -r word file _; do
    [ "$word" = "$name" ] && places=$(grep -vE "^$file:" <<<"$places" || true)
  done <"$others"
  count=$(grep -c . <<<"$places" || true)
  if [ "$count" != 1 ]; then
    echo "--$name is named in $count places:" $places
    found=1
  fi
done
echo "${#names[@]} options"
[ "$found" = 0 ] && [ "${#names[@]}" -gt 0 ]
