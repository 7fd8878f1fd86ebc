#!/usr/bin/env bash
# run.sh MINUTES [TARGET...]: builds the fuzz targets by clang 14 (packages clang-14 and
# libclang-rt-14-dev) under the address and undefined-behaviour sanitizers, and runs each for so many
# minutes, one after the other; all of them if none is named. What a target learns stays in
# build-fuzz/corpus/TARGET (or POLYLOC_FUZZ_CORPUS/TARGET) and is where its next run begins; what it
# finds is in build-fuzz/findings/TARGET-*, and the last log beside it. Prints a line per target:
# runs, seconds, edges of the code that it reached, inputs kept, findings; a target ends with its
# first finding. Exits 1 if anything was found, 2 if a target did not run to its end.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=0 # to libFuzzer 0 means without end
if [[ ${1-} =~ ^[0-9]+(\.[0-9]+)?$ ]]; then
  seconds=$(awk -v minutes="$1" 'BEGIN { print int(60 * minutes) }')
fi
if [ "$seconds" -lt 1 ]; then
  echo "usage: run.sh MINUTES [TARGET...], a second at least" >&2
  exit 2
fi
shift
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  mapfile -t targets < <(sed -n 's/^POLYLOC_FUZZ_TARGET(\([a-z_]*\),.*/\1/p' tests/fuzz/*.cpp | sort)
fi

cmake --preset fuzz > /dev/null
cmake --build --preset fuzz --target fuzz_replay "${targets[@]/#/fuzz_}"
rm -rf build-fuzz/seeds
build-fuzz/bin/fuzz_replay --write-seeds build-fuzz/seeds

export UBSAN_OPTIONS=print_stacktrace=1
worst=0
for target in "${targets[@]}"; do
  status=0
  bash tests/fuzz/run_target.sh build-fuzz "$target" "$seconds" || status=$?
  # A finding is told before a target that did not run.
  if [ "$status" -ne 0 ] && [ "$worst" -ne 1 ]; then worst=$status; fi
done
exit "$worst"
