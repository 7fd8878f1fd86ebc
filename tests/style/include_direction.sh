#!/usr/bin/env bash
# include_direction.sh ROOT: checks who includes whom, prints `FILE:LINE: RULE: TEXT` for each
# offence, exits 1 if there is one.
#   - A folder of mrpt_polyloc/ includes only itself and folders before it in `order` below, and
#     always as <mrpt_polyloc/...>; never apps/ or tests/. A subfolder is a folder of its own: what
#     lies at the door of localization/ comes after its rooms.
#   - CGAL is included only by .cpp files of geometry/ and visibility/ (and by tests): its headers
#     cost 15 s each, and its targets export -frounding-math.
#   - The core (all folders before io/) uses of MRPT only <mrpt/math/...>.
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
  count = split("base geometry visibility polar localization/scan localization/exact " \
                "localization/nearest_cells localization/search localization/ranking " \
                "localization localization/inspection travel io mrpt_bridge evaluation " \
                "evaluation/baselines", order)
  for (i = 1; i <= count; ++i) rank[order[i]] = i
  core = rank["travel"]
}
# The folder of a path that is split at its slashes, below mrpt_polyloc/.
function folderOf(path, parts,    name, i) {
  name = path[2]
  for (i = 3; i < parts; ++i) name = name "/" path[i]
  return name
}
function offence(rule) {
  printf "%s:%d: %s: %s\n", FILENAME, FNR, rule, $0
  failed = 1
}
FNR == 1 {
  parts = split(FILENAME, path, "/")
  library = path[1] == "mrpt_polyloc" && parts > 2
  folder = library ? folderOf(path, parts) : ""
  own = library ? rank[folder] : 0
  if (library && !own) offence("unknown folder " folder)
  may_use_cgal = path[1] == "tests" || \
      (FILENAME ~ /\.cpp$/ && (path[2] == "geometry" || path[2] == "visibility"))
}
/^[ \t]*#[ \t]*include/ {
  target = $0
  sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
  quoted = target ~ /^"/
  gsub(/^[<"]|[>"].*$/, "", target)
  target_parts = split(target, part, "/")

  if (part[1] == "CGAL" && !may_use_cgal) offence("CGAL is not for this file")
  if (!library) next
  if (quoted) offence("not included as <mrpt_polyloc/...>")
  if (part[1] == "apps" || part[1] == "tests") offence("the library needs no " part[1])
  if (part[1] == "mrpt" && own <= core && part[2] != "math") {
    offence("the core uses of MRPT only mrpt/math")
  }
  if (part[1] == "mrpt_polyloc" && target != "mrpt_polyloc/version.h") {
    other = folderOf(part, target_parts)
    if (!(other in rank)) offence("unknown folder " other)
    else if (rank[other] > own) offence(folder " must not know " other)
  }
}
END { exit failed }
' $sources
