#!/usr/bin/env bash
# Whether every source has the layout of .clang-format, by the version that it is made for: files
# not yet committed, too.
# usage: test/format.sh [--fix]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mode=(--dry-run --Werror)
if [ "${1:-}" = "--fix" ]; then
  mode=(-i)
fi
echo "== format: $(clang-format-14 --version)"
git ls-files -z -co --exclude-standard '*.cpp' '*.h' '*.hpp' | xargs -0 -n 100 -P 2 clang-format-14 "${mode[@]}"
