#!/usr/bin/env bash
# rawlog_edit.sh LIBRARY WRITE_MAP_LOG ROOM: MRPT's rawlog-edit, unmodified, reads past a map stored in
# a rawlog once this library is loaded into it (-p), and stops there, complaining of the class, without.
# 77: the program is not installed.
set -euo pipefail
library=$1 write_map_log=$2 room=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if ! command -v rawlog-edit > /dev/null; then
  echo "rawlog-edit (package mrpt-apps) is not installed"
  exit 77
fi
"$write_map_log" "$room" "$scratch/map.rawlog"

info() { rawlog-edit "$@" -i "$scratch/map.rawlog" --info < /dev/null > "$scratch/info" 2>&1; }
names_laser() { grep -Eq ': *laser */ *2 ' "$scratch/info"; }
complains() { grep -q "'mrpt_polyloc::CPolygonMap2D' which is not registered" "$scratch/info"; }

info -p "$library"
cat "$scratch/info"
if ! names_laser || complains; then
  echo "rawlog-edit -p does not read past the map"
  exit 1
fi

info || true # 2.5.8 exits 0 all the same
if names_laser || ! complains; then
  cat "$scratch/info"
  echo "rawlog-edit reads the map without the library"
  exit 1
fi
