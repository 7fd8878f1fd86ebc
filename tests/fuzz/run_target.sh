#!/usr/bin/env bash
# run_target.sh BUILD TARGET SECONDS: lets BUILD/bin/fuzz_TARGET run for so long, from its seeds in
# BUILD/seeds, what was found before in tests/fuzz/found, and what it learned before in
# BUILD/corpus; the folder that POLYLOC_FUZZ_CORPUS names holds the latter instead. Prints one line
# of what came of it. Exit: 1 if something was found, 2 if it did not run to its end for another
# reason.
set -euo pipefail
build=$1 target=$2 seconds=$3
here=$(dirname "${BASH_SOURCE[0]}")
corpus=${POLYLOC_FUZZ_CORPUS:-$build/corpus}/$target
log=$build/findings/$target.log
mkdir -p "$corpus" "$build/findings"

# No -max_len: libFuzzer would cut longer seeds off there, and without it takes their length.
arguments=(-max_total_time="$seconds" -timeout=30 -rss_limit_mb=3000
  -print_final_stats=1 -artifact_prefix="$build/findings/$target-")
if [ -f "$here/dictionaries/$target.dict" ]; then
  arguments+=(-dict="$here/dictionaries/$target.dict")
fi
folders=("$corpus") # the first is where it puts what it learns
for folder in "$build/seeds/$target" "$here/found/$target"; do
  if [ -d "$folder" ]; then folders+=("$folder"); fi
done

inputs() { find "$corpus" -type f -printf '%f\n' | sort; }
before=$(inputs)
status=0 start=$SECONDS
"$build/bin/fuzz_$target" "${arguments[@]}" "${folders[@]}" > "$log" 2>&1 || status=$?
took=$((SECONDS - start))
after=$(inputs)
kept=$(grep -c . <<< "$after" || true)
new=$(comm -13 <(echo "$before") <(echo "$after") | grep -c . || true)
runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
edges=$(grep -aoE 'cov: [0-9]+' "$log" | tail -1 | tr -dc '0-9' || true)
# The log tells which input; the folder may still hold it from an earlier run. A slow unit is told
# of as well, and is none.
found=$(sed -nE 's/.*Test unit written to (.*)/\1/p' "$log" | grep -v '[-]slow-unit-' || true)

# It stops at the first thing that it finds, so that the time run may be less than what was asked.
line="$target: ${runs:-?} runs in $took s of $seconds, ${edges:-?} edges,"
line+=" $kept inputs kept, $new of them new"
if [ -n "$found" ]; then
  echo "$line, FOUND $found"
  exit 1
elif [ "$status" -ne 0 ] || [ -z "$runs" ]; then
  echo "$line, DID NOT RUN to its end (exit $status), see $log"
  exit 2
fi
echo "$line, nothing found"
