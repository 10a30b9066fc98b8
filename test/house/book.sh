#!/usr/bin/env bash
# share/doc/book.tsv says where each method of the book is: section, method, header#name, words of
# a command line, test suite. Checks that all of them exist and that share/doc/book.md is the
# table; with --write, writes it.
# usage: book.sh [--write] SOURCE_DIR BIN_DIR
set -euo pipefail
write=false
if [[ $1 == --write ]]; then write=true; shift; fi
source=$1 bin=$2
rows=$source/share/doc/book.tsv
failed=0
fail() { echo "book.tsv: $*"; failed=1; }

table() {
  cat <<'TEXT'
# The book, section by section

Methods of A. Nüchter, *3D Robotic Mapping* (Springer 2009): for each, the header and the name in it, a command line that runs it, and the
test suite that checks it against the book. `-`: only in the library. Internal headers are not installed. Made from `book.tsv` by `test/house/book.sh --write`; the test `house.book` checks every row.

| section | method | header | name | program | test |
|---|---|---|---|---|---|
TEXT
  while IFS=$'\t' read -r section method place words test; do
    [[ $words == - ]] || words="\`$words\`"
    local kind=
    compgen -G "$source/modules/*/internal/${place%%#*}" > /dev/null && kind=" (internal)"
    echo "| $section | $method | \`${place%%#*}\`$kind | \`${place##*#}\` | $words | \`$test\` |"
  done < "$rows"
}

# The words up to the first option are the program and its job; its --help knows the option, and
# the value behind it.
check_words() {
  local words=($1) command=()
  while ((${#words[@]})) && [[ ${words[0]} != --* ]]; do
    command+=("${words[0]}")
    words=("${words[@]:1}")
  done
  local help
  if ! help=$("$bin/${command[0]}" "${command[@]:1}" --help 2>&1); then
    fail "'$1': ${command[*]} --help fails"
    return
  fi
  for word in "${words[@]}"; do
    grep -qE -- "(^|[^a-z-])$word([^a-z-]|$)" <<< "$help" ||
      fail "'$1': ${command[*]} --help does not know $word"
  done
}

while IFS=$'\t' read -r section method place words test; do
  [[ -n $test ]] || fail "$section $method: five columns are needed"
  header=$(compgen -G "$source/modules/*/include/${place%%#*}" || compgen -G "$source/modules/*/internal/${place%%#*}" || true)
  if [[ -z $header ]]; then
    fail "$section $method: there is no header ${place%%#*}"
  else
    grep -qE "\b${place##*#}\b" "$header" || fail "$section $method: ${place%%#*} has no ${place##*#}"
  fi
  [[ $words == - ]] || check_words "$words"
  grep -rqE "^(TYPED_)?TEST(_P|_F)?\($test," "$source/test" --include='*.cpp' ||
    fail "$section $method: there is no test suite $test"
done < "$rows"

if $write; then
  table > "$source/share/doc/book.md"
elif ! diff <(table) "$source/share/doc/book.md"; then
  fail "share/doc/book.md is another table: test/house/book.sh --write makes it anew"
fi
echo "$(wc -l < "$rows") rows"
exit $failed
