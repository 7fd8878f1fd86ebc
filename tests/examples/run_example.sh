#!/usr/bin/env bash
# run_example.sh PROGRAM: an example follows the robot of MRPT's localization_demo to the end that
# MRPT's own unit test knows: (15.89, -10.0, 4.8 deg). 77: the demo is not installed.
set -euo pipefail
data=/usr/share/mrpt/datasets
if [ ! -f "$data/localization_demo.rawlog" ]; then
  echo "MRPT's localization_demo (package mrpt-common) is not installed"
  exit 77
fi
"$1" "$data/localization_demo.simplemap.gz" "$data/localization_demo.rawlog" | tee /dev/stderr |
  awk '/^pose / { seen = sqrt(($2 - 15.89)^2 + ($3 + 10)^2) < 0.3 && ($4 - 4.8)^2 < 25 }
       END { exit !seen }'
