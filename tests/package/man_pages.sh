#!/usr/bin/env bash
# man_pages.sh MAN_DIR PROGRAM...: the manual page of a program names it, holds each option that its
# --help lists, and is in order by groff, where that is there.
set -euo pipefail
pages=$1
shift
for program; do
  name=$(basename "$program")
  page=$(zcat "$pages/$name.1.gz")
  grep -qF -e "${name//-/\\-} \\- " <<< "$page" || { echo "$name: no name line" >&2; exit 1; }
  for option in $("$program" --help | grep -oE '^  --?[a-z0-9-]+' | tr -d ' '); do
    grep -qF -e ".B ${option//-/\\-}" <<< "$page" || { echo "$name: no $option" >&2; exit 1; }
  done
  if command -v groff > /dev/null; then
    complaints=$(groff -man -ww -z <<< "$page" 2>&1)
    [ -z "$complaints" ] || { echo "$name: $complaints" >&2; exit 1; }
  fi
done
