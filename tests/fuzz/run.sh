#!/usr/bin/env bash
# run.sh MINUTES [TARGET...]: builds the fuzz targets by clang 14 (packages clang-14 and
# libclang-rt-14-dev) under the address and undefined-behaviour sanitizers, and runs each for so many
# minutes, one after the other; all of them if none is named. What a target learns stays in
# build-fuzz/corpus/TARGET, what it finds in build-fuzz/findings/TARGET-*. Prints a line per target:
# runs, edges of the code that it reached, inputs kept, findings. Exits 1 if anything was found.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if [ $# -lt 1 ] || ! [[ $1 =~ ^[0-9]+(\.[0-9]+)?$ ]]; then
  echo "usage: run.sh MINUTES [TARGET...]" >&2
  exit 2
fi
seconds=$(awk -v minutes="$1" 'BEGIN { print int(60 * minutes) }')
shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  mapfile -t targets < <(sed -n 's/^POLYLOC_FUZZ_TARGET(\([a-z_]*\),.*/\1/p' tests/fuzz/*.cpp | sort)
fi

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target fuzz_replay "${targets[@]/#/fuzz_}"
build="build-fuzz"
"$build/bin/fuzz_replay" --write-seeds "$build/seeds"
mkdir -p "$build/findings"

export UBSAN_OPTIONS=print_stacktrace=1
found=0
for target in "${targets[@]}"; do
  corpus=$build/corpus/$target log=$build/findings/$target.log
  mkdir -p "$corpus"
  arguments=(-max_total_time="$seconds" -timeout=30 -rss_limit_mb=3000 -max_len=4096
    -print_final_stats=1 -artifact_prefix="$build/findings/$target-")
  if [ -f "tests/fuzz/dictionaries/$target.dict" ]; then
    arguments+=(-dict="tests/fuzz/dictionaries/$target.dict")
  fi
  folders=("$corpus" "$build/seeds/$target")
  if [ -d "tests/fuzz/found/$target" ]; then folders+=("tests/fuzz/found/$target"); fi
  status=0
  "$build/bin/fuzz_$target" "${arguments[@]}" "${folders[@]}" > "$log" 2>&1 || status=$?
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(grep -oE 'cov: [0-9]+' "$log" | tail -1 | tr -dc '0-9' || true)
  kept=$(find "$corpus" -type f | wc -l)
  echo "$target: ${runs:-?} runs, ${edges:-?} edges, $kept inputs kept, $([ "$status" -eq 0 ] \
    && echo "nothing found" || echo "FOUND, see $log")"
  [ "$status" -eq 0 ] || found=1
done
exit "$found"
