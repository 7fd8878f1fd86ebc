#!/bin/sh
# man_page.sh EXECUTABLE NAME VERSION DATE OUT.gz: the manual page of a program, from its --help.
set -eu
mkdir -p "$(dirname "$5")"
help=$("$1" --help)
printf '%s\n' "$help" |
  awk -v name="$2" -v version="$3" -v date="$4" -f "$(dirname "$0")/man_page.awk" > "$5.txt"
gzip -9nc "$5.txt" > "$5.new"
rm "$5.txt"
mv "$5.new" "$5"
