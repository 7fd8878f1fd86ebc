#!/usr/bin/env bash
# tidy.sh [BUILD_DIR]: clang-tidy 14 with .clang-tidy over the library's core (all folders
# before io/); needs BUILD_DIR/compile_commands.json (default build-dev/: the
# gate joins files). Not part of the gate: see CONTRIBUTING.md. Exits non-zero on any finding.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build-dev}
if [ ! -f "$build/compile_commands.json" ]; then
  echo "tidy.sh: no $build/compile_commands.json; run: cmake --preset dev" >&2
  exit 1
fi
find mrpt_polyloc/{base,geometry,visibility,polar,localization} -name '*.cpp' -print0 |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p "$build" --quiet
