#!/usr/bin/env bash
# format.sh ROOT: every source must be as clang-format 14 leaves it (other versions differ); exits
# 77 (skipped) where that version is not installed. To fix: clang-format-14 -i FILES.
set -euo pipefail
cd "${1:?usage: format.sh ROOT}"
for program in clang-format-14 clang-format; do
  if "$program" --version 2>/dev/null | grep -q 'version 14\.'; then
    find mrpt_polyloc apps tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
      xargs -0 "$program" --dry-run -Werror
    exit
  fi
done
echo "clang-format 14 is not installed"
exit 77
