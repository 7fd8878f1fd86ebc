#!/usr/bin/env bash
# pf_localization.sh LIBRARY POLYLOC_LOCALIZE INI: Debian's pf-localization, unmodified, localizes
# MRPT's demo with a polygon map once the library is loaded into it, and does not without. 77: the
# program or the data are not installed.
set -euo pipefail
library=$1 polyloc_localize=$2 ini=$3
data=/usr/share/mrpt/datasets
if ! command -v pf-localization > /dev/null || [ ! -f "$data/localization_demo.rawlog" ]; then
  echo "pf-localization (package mrpt-apps) or its demo (mrpt-common) is not installed"
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch" # the program writes its logs where it stands

# last_error LOG: how far the last estimate is from the pose in MRPT's own unit test, and by how
# much it is turned: "METRES DEGREES".
last_error() {
  sed -nE 's/.*PDF estimation: \(([-0-9.]+),([-0-9.]+),([-0-9.]+)deg\).*/\1 \2 \3/p' "$1" | tail -1 |
    awk '{ turn = $3 - 4.8; if (turn < 0) turn = -turn; print sqrt(($1 - 15.89)^2 + ($2 + 10)^2), turn }'
}
is_right() { awk '{ exit !($1 < 0.3 && $2 < 5) }' <<< "$1"; }

LD_PRELOAD=$library pf-localization "$ini" < /dev/null > with.log 2>&1 || {
  tail -20 with.log
  exit 1
}
found=$(last_error with.log)
echo "with the library: off by $found"
[ -n "$found" ] && is_right "$found"

pf-localization "$ini" < /dev/null > without.log 2>&1 || true
lost=$(last_error without.log)
echo "without: ${lost:+off by }${lost:-no estimate}"
[ -z "$lost" ] || ! is_right "$lost"

# The box in the ini is what polyloc-localize writes for the first scan.
"$polyloc_localize" --map "$data/localization_demo.simplemap.gz" --scans "$data/localization_demo.rawlog" \
  --rows 0 --pf-ini box.ini > /dev/null
awk -F= '
  /^init_PDF_(min|max)_/ { value = $2 + 0 }
  /^init_PDF_(min|max)_/ && NR == FNR { box[$1] = value; next }
  /^init_PDF_(min|max)_/ { seen++; off = value - box[$1]; if (off > 0.1 || off < -0.1) bad = 1 }
  END { exit bad || seen != 6 }' box.ini "$ini"
