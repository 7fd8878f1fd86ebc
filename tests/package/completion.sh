#!/usr/bin/env bash
# completion.sh COMPLETION PROGRAM...: bash completes each option that a program's --help lists, the
# names of --method, and else the names of files.
set -euo pipefail
# shellcheck source=/dev/null
. "$1"
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
touch "$work/floor.wkt" "$work/floor two.wkt"

# completed WORD...: what there is for the last of the words.
completed() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _polyloc
  printf '%s\n' "${COMPREPLY[@]-}"
}
# expect TEXT WANTED: the same, or an end.
expect() {
  [ "$1" = "$2" ] || { printf 'completed: %s\nwanted: %s\n' "$1" "$2" >&2; exit 1; }
}

for program; do
  complete -p "$(basename "$program")" > /dev/null
  options=$("$program" --help | sed -nE 's/^  (-h,)?(--[a-z0-9-]+).*/\2/p' | sort)
  [ -n "$options" ]
  expect "$(completed "$program" -- | sort)" "$options"
  expect "$(completed "$program" --method cer)" certified
  expect "$(completed "$program" "$work/floor.w")" "$work/floor.wkt"
  expect "$(completed "$program" "$work/floor t")" "$work/floor two.wkt"
done
