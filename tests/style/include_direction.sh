#!/usr/bin/env bash
# include_direction.sh ROOT: checks who includes whom, prints `FILE:LINE: RULE: TEXT` for each
# offence, exits 1 if there is one.
#   - A folder of mrpt_polyloc/ includes only itself and folders before it in `order` below, and
#     always as <mrpt_polyloc/...>; never apps/ or tests/.
#   - CGAL is included only by .cpp files of geometry/ and visibility/ (and by tests): its headers
#     cost 15 s each, and its targets export -frounding-math.
#   - The core (all folders but mrpt_bridge/ and evaluation/) uses of MRPT only <mrpt/math/...>.
set -euo pipefail
cd "${1:?usage: include_direction.sh ROOT}"

sources=$(find mrpt_polyloc apps tests -name '*.h' -o -name '*.cpp' | LC_ALL=C sort)
if [ -z "$sources" ]; then
  echo "no sources under $PWD" >&2
  exit 1
fi
# File names of the project hold no white space.
# shellcheck disable=SC2086
exec awk '
BEGIN {
  count = split("geometry visibility polar localization travel mrpt_bridge evaluation", order)
  for (i = 1; i <= count; ++i) rank[order[i]] = i
  core = rank["travel"]
}
function offence(rule) {
  printf "%s:%d: %s: %s\n", FILENAME, FNR, rule, $0
  failed = 1
}
FNR == 1 {
  parts = split(FILENAME, path, "/")
  library = path[1] == "mrpt_polyloc" && parts > 2
  own = library ? rank[path[2]] : 0
  if (library && !own) offence("unknown folder " path[2])
  may_use_cgal = path[1] == "tests" || \
      (FILENAME ~ /\.cpp$/ && (path[2] == "geometry" || path[2] == "visibility"))
}
/^[ \t]*#[ \t]*include/ {
  target = $0
  sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
  quoted = target ~ /^"/
  gsub(/^[<"]|[>"].*$/, "", target)
  split(target, part, "/")

  if (part[1] == "CGAL" && !may_use_cgal) offence("CGAL is not for this file")
  if (!library) next
  if (quoted) offence("not included as <mrpt_polyloc/...>")
  if (part[1] == "apps" || part[1] == "tests") offence("the library needs no " part[1])
  if (part[1] == "mrpt" && own <= core && part[2] != "math") {
    offence("the core uses of MRPT only mrpt/math")
  }
  if (part[1] == "mrpt_polyloc" && target != "mrpt_polyloc/version.h") {
    if (!(part[2] in rank)) offence("unknown folder " part[2])
    else if (rank[part[2]] > own) offence(path[2] " must not know " part[2])
  }
}
END { exit failed }
' $sources
