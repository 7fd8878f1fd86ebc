#!/usr/bin/env bash
# A run of a fuzz target tells of what it did and kept: by programs that behave as libFuzzer's do.
set -euo pipefail
run=$1/tests/fuzz/run_target.sh
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root/bin" "$root/seeds/demo" "$root/corpus/demo"
echo seed > "$root/seeds/demo/0"
echo old > "$root/corpus/demo/a"

# program LINES: fuzz_demo does this, with its corpus as $corpus and the prefix of artifacts as
# $prefix.
program() {
  {
    printf '%s\n' '#!/usr/bin/env bash' 'for word; do case $word in' \
      '-artifact_prefix=*) prefix=${word#*=} ;;' '-max_len=*) exit 9 ;;' '-*) ;;' \
      '*) corpus=${corpus-$word} ;;' 'esac; done'
    cat
  } > "$root/bin/fuzz_demo"
  chmod +x "$root/bin/fuzz_demo"
}
# expect EXIT WANTED: what is told, but for the seconds that it took.
expect() {
  local status=0 told
  told=$(bash "$run" "$root" demo 60) || status=$?
  told=$(sed -E 's/in [0-9]+ s/in T s/' <<< "$told")
  [ "$status $told" = "$1 demo: $2" ] || {
    printf 'told:   %s\nwanted: %s\n' "$status $told" "$1 demo: $2"
    exit 1
  }
}

program << 'RUN'
echo new > "$corpus/b"; rm -f "$corpus/a"; echo new > "$corpus/c"
echo '#2 INITED cov: 4 ft: 4'; echo '#9 NEW    cov: 17 ft: 20'
echo "Test unit written to ${prefix}slow-unit-1"
echo 'stat::number_of_executed_units: 123'
RUN
expect 0 "123 runs in T s of 60, 17 edges, 2 inputs kept, 2 of them new, nothing found"
expect 0 "123 runs in T s of 60, 17 edges, 2 inputs kept, 0 of them new, nothing found"

rest="runs in T s of 60, ? edges, 2 inputs kept, 0 of them new" nothing="? $rest"
log=$root/findings/demo.log
program << 'RUN'
echo "artifact_prefix='x'; Test unit written to ${prefix}crash-1"
echo 'stat::number_of_executed_units: 5'
exit 77
RUN
expect 1 "5 $rest, FOUND $root/findings/demo-crash-1"

# As where the dictionary cannot be read, or the program not be started.
program <<< 'exit 1'
expect 2 "$nothing, DID NOT RUN to its end (exit 1), see $log"
program <<< 'exit 0'
expect 2 "$nothing, DID NOT RUN to its end (exit 0), see $log"
rm "$root/bin/fuzz_demo"
expect 2 "$nothing, DID NOT RUN to its end (exit 127), see $log"

# Inputs may be kept elsewhere.
program <<< 'echo new > "$corpus/d"; echo "stat::number_of_executed_units: 1"'
export POLYLOC_FUZZ_CORPUS=$root/elsewhere
expect 0 "1 runs in T s of 60, ? edges, 1 inputs kept, 1 of them new, nothing found"
[ -f "$root/elsewhere/demo/d" ]

# No time means no end to libFuzzer.
for minutes in 0 0.01 x ""; do
  if bash "$1/tests/fuzz/run.sh" "$minutes" demo 2> /dev/null; then exit 1; fi
done
