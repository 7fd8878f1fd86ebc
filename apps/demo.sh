#!/usr/bin/env bash
# demo.sh: on a bare Debian 12, 13 or testing (as root or with sudo) installs what is missing, builds
# the programs, localizes every scan of MRPT's localization_demo (each by itself, knowing nothing of
# the others), and draws demo.svg in the project's root. The last line is the robot's pose at the
# last scan: pose X Y PHI_DEG.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash cmake/install-debian-packages.sh

echo "== build"
cmake -S . -B build-demo -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DCMAKE_UNITY_BUILD=ON > /dev/null
cmake --build build-demo --parallel "$(nproc)"

echo "== localize"
data=/usr/share/mrpt/datasets
results=$(mktemp)
trap 'rm -f "$results"' EXIT
build-demo/bin/polyloc-localize --map "$data/localization_demo.simplemap.gz" \
  --scans "$data/localization_demo.rawlog" --svg demo.svg -o "$results"

# Columns: row,stamp,status,rank,x,y,phi_deg,...: the first hypothesis of every scan.
awk -F, '$4 == 1 { printf "scan %2d: %-9s %7.2f %7.2f %7.1f\n", $1, $3, $5, $6, $7 }' "$results"
echo "picture: $PWD/demo.svg"
echo "to look at it in a browser, http://127.0.0.1:8765/ : build-demo/bin/polyloc-view" \
  "--map $data/localization_demo.simplemap.gz --scans $data/localization_demo.rawlog"
awk -F, '
  NR > 1 { last = $1 }
  $4 == 1 { row = $1; pose = $5 " " $6 " " $7 }
  END {
    if (row == "" || row != last) { print "the last scan was not localized" > "/dev/stderr"; exit 1 }
    print "pose " pose
  }' "$results"
