#!/usr/bin/env bash
# scene_viewer.sh POLYLOC_MAP ROOM: MRPT's SceneViewer3D, unmodified, shows the scene that polyloc-map
# writes of a map; without a scene it shows none of its colours. 77: a program is not installed.
set -euo pipefail
polyloc_map=$1 room=$2
scratch=$(mktemp -d)
# shellcheck source=/dev/null
. "$(dirname "${BASH_SOURCE[0]}")/virtual_display.sh"
require SceneViewer3D Xvfb xdotool
trap 'end_display; rm -rf "$scratch"' EXIT

"$polyloc_map" "$room" --3dscene "$scratch/room.3Dscene" > /dev/null
start_display

start_program SceneViewer3D SceneViewer3D "$scratch/room.3Dscene"
wait_until 60 shows_map || {
  echo "the map is not seen: $(paste -s -d ';' "$scratch/map_pixels")"
  exit 1
}
echo "seen: $(paste -s -d ';' "$scratch/map_pixels")"
end_program

start_program SceneViewer3D SceneViewer3D
sleep 5 # what it could show it would show by now
shows_no_map
