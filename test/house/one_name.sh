#!/usr/bin/env bash
# Every type of the suite is defined once: no two files below a folder define a class, struct,
# union or enum of one qualified name. Types of unnamed namespaces belong to their file.
# usage: one_name.sh FOLDER
set -euo pipefail
mapfile -d '' files < <(find "$1" -type f \( -name '*.h' -o -name '*.hpp' -o -name '*.cpp' \) -print0)
awk '
  # The code is clang-formatted: namespaces open and close at the start of a line, and what
  # is indented is no member of a namespace.
  FNR == 1 { depth = 0 }
  /^namespace .*\{$/ || /^namespace \{$/ {
    name = $0
    sub(/^namespace */, "", name); sub(/ *\{$/, "", name); sub(/^PCL6D_EXPORTS /, "", name)
    scope[depth++] = name
    next
  }
  /^\} \/\/ namespace/ { --depth; next }
  /^(template <.*> *)?(class|struct|union|enum class|enum) [A-Za-z0-9_]+( final)?( :.*)?( \{.*)?$/ && !/;$/ {
    line = $0
    sub(/^template <.*> */, "", line)
    split(line, word, /[ :{]+/)
    type = word[1] == "enum" && word[2] == "class" ? word[3] : word[2]
    qualified = ""
    unnamed = 0
    for (i = 0; i < depth; ++i) {
      unnamed = unnamed || scope[i] == ""
      qualified = qualified scope[i] "::"
    }
    qualified = qualified type
    if (unnamed || depth == 0) next
    if (qualified in at && at[qualified] != FILENAME) {
      print qualified " is defined in " at[qualified] " and in " FILENAME
      found = 1
    }
    at[qualified] = FILENAME
    ++count
  }
  END { print count " types"; exit found || count < 2 }' "${files[@]}"
