#!/usr/bin/env bash
# The include check must find each kind of offence, name its line, and leave good files alone.
set -euo pipefail
check="$(dirname "${BASH_SOURCE[0]}")/include_direction.sh"
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
failures=0

# expect FILE INCLUDE_LINE EXPECTED: EXPECTED is a part of the message, or empty for a good file.
expect() {
  local file="$root/$1" message status=0
  rm -rf "$root"/*
  mkdir -p "$root"/{mrpt_polyloc,apps,tests} "$(dirname "$file")"
  printf '#pragma once\n\n%s\n' "$2" > "$file"
  message=$(bash "$check" "$root" 2>&1) || status=$?
  if [ -z "$3" ]; then
    [ "$status" -eq 0 ] && [ -z "$message" ] && return
  else
    [ "$status" -ne 0 ] && [[ "$message" == "$1:3: "*"$3"* ]] && return
  fi
  echo "FAILED: '$2' in $1: expected '${3:-no offence}', got status $status, '$message'"
  failures=$((failures + 1))
}

expect mrpt_polyloc/geometry/a.h '#include <mrpt_polyloc/polar/b.h>' 'geometry must not know polar'
expect mrpt_polyloc/polar/a.cpp '  # include <mrpt_polyloc/localization/b.h>' 'polar must not know'
expect mrpt_polyloc/mrpt_bridge/a.h '#include <mrpt_polyloc/evaluation/b.h>' 'must not know evaluation'
expect mrpt_polyloc/polar/a.h '#include <mrpt_polyloc/helpers/b.h>' 'unknown folder helpers'
expect mrpt_polyloc/localization/search/a.h '#include <mrpt_polyloc/localization/b.h>' \
  'localization/search must not know localization'
expect mrpt_polyloc/localization/search/a.h '#include <mrpt_polyloc/localization/ranking/b.h>' \
  'localization/search must not know localization/ranking'
expect mrpt_polyloc/io/a.h '#include <mrpt_polyloc/mrpt_bridge/b.h>' 'io must not know mrpt_bridge'
expect mrpt_polyloc/polar/a.h '#include "b.h"' 'not included as'
expect mrpt_polyloc/polar/a.h '#include <tests/support/b.h>' 'needs no tests'
expect mrpt_polyloc/evaluation/a.h '#include <apps/common/b.h>' 'needs no apps'
expect mrpt_polyloc/geometry/a.h '#include <CGAL/Origin.h>' 'CGAL is not for'
expect mrpt_polyloc/visibility/a.h '#include <CGAL/Origin.h>  // why' 'CGAL is not for'
expect mrpt_polyloc/localization/a.cpp '#include <CGAL/Origin.h>' 'CGAL is not for'
expect apps/polyloc-map/main.cpp '#include <CGAL/Origin.h>' 'CGAL is not for'
expect mrpt_polyloc/geometry/a.cpp '#include <mrpt/obs/CObservation.h>' 'only mrpt/math'
expect mrpt_polyloc/travel/a.cpp '#include <mrpt/system/filesystem.h>' 'only mrpt/math'

expect mrpt_polyloc/geometry/a.cpp '#include <CGAL/Origin.h>' ''
expect mrpt_polyloc/visibility/a.cpp '#include <CGAL/Origin.h>' ''
expect tests/visibility/a_test.cpp '#include <CGAL/Origin.h>' ''
expect tests/support/a.h '#include "b.h"' ''
expect mrpt_polyloc/localization/a.h '#include <mrpt_polyloc/geometry/b.h>' ''
expect mrpt_polyloc/localization/a.h '#include <mrpt_polyloc/localization/b.h>' ''
expect mrpt_polyloc/localization/a.h '#include <mrpt_polyloc/localization/search/b.h>' ''
expect mrpt_polyloc/localization/search/a.h '#include <mrpt_polyloc/localization/scan/b.h>' ''
expect mrpt_polyloc/io/a.h '#include <mrpt/obs/CObservation.h>' ''
expect mrpt_polyloc/localization/a.h '#include <mrpt/math/TPose2D.h>' ''
expect mrpt_polyloc/mrpt_bridge/a.h '#include <mrpt/obs/CObservation.h>' ''
expect mrpt_polyloc/evaluation/a.h '#include <mrpt_polyloc/version.h>' ''
expect mrpt_polyloc/polar/a.h '// #include <CGAL/Origin.h>' ''

# A tree without sources is a wrong ROOT, not a clean one.
rm -rf "$root"/*
mkdir -p "$root"/{mrpt_polyloc,apps,tests}
if bash "$check" "$root" > /dev/null 2>&1; then
  echo "FAILED: a tree without sources passed"
  failures=$((failures + 1))
fi
exit $((failures > 0))
