#!/usr/bin/env bash
# run.sh: all tests, on Debian 12, 13 or testing. Installs the packages that are missing, then builds
# and tests twice: release (build/), and under the address and undefined-behaviour sanitizers
# (build-asan/). Ends with a line `N passed, N failed, N skipped` over both; exits non-zero if
# anything failed. Tests on evaluation data run if POLYLOC_DATA names it. With POLYLOC_WERROR=ON
# warnings are errors, as in the CI job (.ci/run): other compilers than its own warn of other things.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash cmake/install-debian-packages.sh tests

passed=0 failed=0 skipped=0
reports=$(mktemp -d)
trap 'rm -rf "$reports"' EXIT

# build_and_test PRESET: a failed test is counted, a failed build ends the gate.
build_and_test() {
  local folder=build report="$reports/$1.xml" good bad skip
  [ "$1" = gate ] || folder=build-$1
  echo "== $1: configure and build"
  cmake --preset "$1"
  cmake --build --preset "$1" --parallel "$(nproc)"
  echo "== $1: test"
  rm -rf "$folder/test-reports"
  ctest --preset "$1" --parallel 2 --no-tests=error --output-junit "$report" || true
  read -r good bad skip < <(python3 tests/count_results.py "$report" "$folder/test-reports")
  passed=$((passed + good))
  failed=$((failed + bad))
  skipped=$((skipped + skip))
}

build_and_test gate
build_and_test asan

echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
