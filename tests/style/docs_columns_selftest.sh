#!/usr/bin/env bash
# The test of line lengths finds what it is for, and no more.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
wide=$(printf 'x%.0s' $(seq 101))
printf '%s\n' "${wide%x}" "| $wide |" > "$root/good.md"
bash "$here/docs_columns.sh" "$root"
mkdir "$root/doc"
printf 'short\n%s\n' "$wide" > "$root/doc/bad.md"
if found=$(bash "$here/docs_columns.sh" "$root"); then
  echo "a line of 101 columns was not found" >&2
  exit 1
fi
[ "$found" = "./doc/bad.md:2: 101 columns" ] || { echo "found: $found" >&2; exit 1; }
