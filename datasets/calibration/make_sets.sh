#!/usr/bin/env bash
# make_sets.sh BIN OUT: what the built-in calibration is fitted on, as a list for polyloc-calibrate:
# the seven real sets, four of them with their maps' cells two and four times as large, and offices
# drawn as polygons and as grids of three kinds, with half circles and full ones.
# POLYLOC_DATA names the folder of the sets; BIN is that of the programs.
#   POLYLOC_DATA=... datasets/calibration/make_sets.sh build/bin OUT
#   build/bin/polyloc-calibrate OUT/sets.txt -o OUT/fit --lost 0.001
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: make_sets.sh BIN OUT" >&2; exit 2; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=$(cd "$1" && pwd)
mkdir -p "$2"
cd "$2"
sets="${POLYLOC_DATA:?names the folder of the sets}/scans"

add() { echo "$*" >> sets.new; }
rm -f sets.new
for set in intel fr079 csail aces gh25_sim malaga_fac locdemo; do
  files="$sets/$set/scans.rawlog $sets/$set/truth.tum $sets/$set/good.txt"
  add "$set" "$sets/$set/map.yaml" "$files"
  case $set in gh25_sim | malaga_fac | locdemo) continue ;; esac
  for factor in 2 4; do
    python3 "$here/coarser_map.py" "$sets/$set/map.yaml" $factor "$set-$factor"
    add "$set/$factor" "$set-$factor.yaml" "$files"
  done
done
for seed in 3 5 8; do
  python3 "$here/office_plan.py" $seed 90 > "office$seed.wkt"
  for cell in 0.05 0.1 0.2; do
    python3 "$here/draw_map.py" "office$seed.wkt" $cell "office$seed-$cell"
  done
  for fov in 180 360; do
    scans="office$seed-$fov"
    "$bin/polyloc-simulate" --map "office$seed.wkt" -n 150 --seed $seed --beams $((fov == 360 ? 360 : 181)) \
      --fov $fov --sigma 0.01 -o "$scans" > /dev/null
    for map in "office$seed.wkt" "office$seed-0.05.yaml" "office$seed-0.1.yaml" "office$seed-0.2.yaml"; do
      add "office$seed/$fov/$map" "$map" "$scans/scans.rawlog" "$scans/truth.tum"
    done
  done
done
mv sets.new sets.txt
