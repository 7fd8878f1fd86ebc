#!/usr/bin/env bash
# run_shares.sh LIST.yaml N OUT [OPTION...]: runs a list in N shares on this machine by GNU parallel
# (package parallel), as many at once as there are cores, and puts them together in OUT. Run again
# after a kill, it goes on. POLYLOC_EVAL names the program where it is not on the path.
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: run_shares.sh LIST.yaml N OUT [OPTION of polyloc-eval...]" >&2
  exit 2
fi
list=$1 shares=$2 out=$3
shift 3
eval=${POLYLOC_EVAL:-polyloc-eval}
[ ! -e "$out/summary.json" ] || { echo "$out: holds results already" >&2; exit 1; }
mkdir -p "$out.shares"
seq "$shares" | parallel --will-cite --halt soon,fail=1 \
  "$eval" "$list" --shard "{}/$shares" --resume -o "$out.shares/{}" "$@"
rm -rf "$out" # what a merge that was killed left
"$eval" merge $(seq -f "$out.shares/%g" "$shares") -o "$out"
