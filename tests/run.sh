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

# attribute NAME FILE: the value of an attribute of the report's first element.
attribute() {
  tr '\n' ' ' < "$2" | grep -oE "<testsuite [^>]*" | grep -oE "\b$1=\"[0-9]+\"" | tr -dc '0-9'
}

# build_and_test PRESET: a failed test is counted, a failed build ends the gate.
build_and_test() {
  local report="$reports/$1.xml" total bad skip
  echo "== $1: configure and build"
  cmake --preset "$1"
  cmake --build --preset "$1" --parallel "$(nproc)"
  echo "== $1: test"
  ctest --preset "$1" --parallel 2 --no-tests=error --output-junit "$report" || true
  total=$(attribute tests "$report")
  if [ "$total" -eq 0 ]; then
    echo "$1: no tests were found" >&2
    exit 1
  fi
  bad=$(attribute failures "$report")
  skip=$(($(attribute skipped "$report") + $(attribute disabled "$report")))
  passed=$((passed + total - bad - skip))
  failed=$((failed + bad))
  skipped=$((skipped + skip))
}

build_and_test gate
build_and_test asan

echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
