#!/usr/bin/env bash
# rawlog_viewer.sh LIBRARY WRITE_MAP_LOG ROOM: MRPT's RawLogViewer, unmodified, shows a map stored in a
# rawlog once this library is loaded into it (-l) and the map's row is selected; not before, and not
# without the library. 77: a program is not installed.
set -euo pipefail
library=$1 write_map_log=$2 room=$3
scratch=$(mktemp -d)
# shellcheck source=/dev/null
. "$(dirname "${BASH_SOURCE[0]}")/virtual_display.sh"
require RawLogViewer Xvfb xdotool
trap 'end_display; rm -rf "$scratch"' EXIT

"$write_map_log" "$room" "$scratch/map.rawlog"
start_display

# close_dialog TITLE: dialogs swallow all clicks. Whether there was one of that title.
close_dialog() {
  wait_until 60 find_window "$1" || return 1
  # shellcheck disable=SC2154
  xdotool windowfocus "$window" key Escape
  wait_until 30 is_gone "$window"
}
is_gone() { ! grep -qx "$1" <<< "$(xdotool search --onlyvisible --name . 2> /dev/null)"; }

# select_row SECONDS: clicks on the rows of the tree on the left, from above (their heights go with
# the fonts that are installed), until the map is seen; that long after each click.
select_row() {
  local y
  for y in 105 115 125 135 145; do
    xdotool mousemove 160 "$y" click 1
    wait_until "$1" shows_map && return 0
  done
  return 1
}

start_program RawlogViewer RawLogViewer -l "$library" "$scratch/map.rawlog"
close_dialog "Tip of the Day"
fill_screen
sleep 2
shows_no_map || {
  echo "the colours of the map are there before its row is selected"
  exit 1
}
select_row 10 || {
  echo "the map is not seen: $(paste -s -d ';' "$scratch/map_pixels")"
  cat "$scratch/program.log"
  exit 1
}
echo "seen: $(paste -s -d ';' "$scratch/map_pixels")"
end_program

start_program RawlogViewer RawLogViewer "$scratch/map.rawlog"
close_dialog "Zero entries loaded" # it says so itself
close_dialog "Tip of the Day"
fill_screen
if select_row 1 || ! shows_no_map; then
  echo "the map is seen without the library"
  exit 1
fi
