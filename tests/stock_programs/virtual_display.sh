# virtual_display.sh: sourced by the tests of programs with windows. A display of our own, without a
# window manager, whose pixels are read from the file that Xvfb keeps them in.
# Needs $scratch, a folder; what runs in the display is ended by end_display.
# shellcheck shell=bash disable=SC2154

# require NAME...: skips the test (77) where a program is not installed.
require() {
  local name
  for name in "$@"; do
    command -v "$name" > /dev/null && continue
    echo "$name is not installed (cmake/install-debian-packages.sh tests)"
    exit 77
  done
}

start_display() {
  mkdir "$scratch/screen" "$scratch/home"
  Xvfb -displayfd 3 -screen 0 1280x800x24 -fbdir "$scratch/screen" -nolisten tcp -noreset \
    3> "$scratch/display" 2> "$scratch/Xvfb.log" &
  display_pid=$!
  wait_until 30 test -s "$scratch/display" || {
    cat "$scratch/Xvfb.log"
    return 1
  }
  DISPLAY=:$(cat "$scratch/display")
  # A home of its own, and Mesa's software renderer: the same on every machine.
  export DISPLAY HOME=$scratch/home LIBGL_ALWAYS_SOFTWARE=1
}

end_display() {
  end_program
  [ -z "${display_pid-}" ] || kill "$display_pid" 2> /dev/null || true
}

# wait_until SECONDS COMMAND...: whether the command succeeds within that time.
wait_until() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || return 1
    sleep 0.5
  done
}

# start_program TITLE COMMAND...: starts it, waits for its window and has that fill the screen.
start_program() {
  local title=$1
  shift
  "$@" < /dev/null > "$scratch/program.log" 2>&1 &
  program_pid=$!
  wait_until 90 find_window "$title" || {
    echo "no window '$title' of: $*"
    cat "$scratch/program.log"
    return 1
  }
  main_window=$window
  fill_screen
}

fill_screen() { xdotool windowmove "$main_window" 0 0 windowsize "$main_window" 1280 800; }

# find_window TITLE: the first visible window whose title begins so, as $window.
find_window() {
  window=$(xdotool search --onlyvisible --name "^$1" 2> /dev/null) || return 1
  window=${window%%$'\n'*}
  [ -n "$window" ]
}

end_program() {
  [ -n "${program_pid-}" ] || return 0
  kill -KILL "$program_pid" 2> /dev/null || true
  wait "$program_pid" 2> /dev/null || true
  program_pid=
}

# map_pixels: a line "COUNT LEFT TOP RIGHT BOTTOM" each for the pixels of walls, of open edges and of
# walls beyond that are seen in a 3D view; "0" for none. The dump of the screen has a big-endian header
# (its word 0 is its length, word 12 the bytes in a row, word 19 the number of colours, which follow in
# 12 bytes each) and then the rows. A 3D view is what lies between pixels of its grey, 102; lines are
# smoothed, so that a pixel of one is a mixture of the grey and the line's colour.
map_pixels() {
  local dump=$scratch/screen/Xvfb_screen0 header
  read -r -a header < <(od -An -v --endian=big -tu4 -w100 -N 100 "$dump")
  od -An -v --endian=little -tx4 -w"${header[12]}" -j $((header[0] + 12 * header[19])) "$dump" |
    awk '
      function byte(text, at) {
        return 16 * index(digits, substr(text, at, 1)) + index(digits, substr(text, at + 1, 1)) - 17
      }
      function off(value, full, share) {
        value -= 102 + share * (full - 102)
        return value < -6 || value > 6
      }
      function mixes(r, g, b, red, green, blue, share) {
        return share >= 0.4 && share <= 1.05 && !off(r, red, share) && !off(g, green, share) &&
               !off(b, blue, share)
      }
      function kind_of(text, r, g, b) {
        r = byte(text, 3); g = byte(text, 5); b = byte(text, 7)
        if (mixes(r, g, b, 20, 30, 90, (102 - r) / 82)) return 1
        if (mixes(r, g, b, 255, 140, 0, (102 - b) / 102)) return 2
        if (mixes(r, g, b, 130, 130, 130, (r - 102) / 28)) return 3
        return 0
      }
      BEGIN { digits = "0123456789abcdef" }
      { first = 0
        for (x = 1; x <= NF; x++) if ($x == "00666666") { if (!first) first = x; last = x }
        if (!first || last - first < 300) next
        for (x = first; x <= last; x++) {
          if (!($x in kinds)) kinds[$x] = kind_of($x)
          if (!(k = kinds[$x])) continue
          if (!count[k]++) { left[k] = right[k] = x; top[k] = NR }
          if (x < left[k]) left[k] = x
          if (x > right[k]) right[k] = x
          bottom[k] = NR } }
      END { for (k = 1; k <= 3; k++)
              print count[k] ? count[k] " " left[k] " " top[k] " " right[k] " " bottom[k] : 0 }' \
      > "$scratch/map_pixels"
}

# shows_map: whether the whole of room.geojson can be seen on the screen, as some perspective shows it:
# the walls are three of the four sides and a pillar, the open edge is the fourth side, and the wall
# beyond lies past it, away from the walls.
shows_map() {
  map_pixels
  paste -s -d ' ' "$scratch/map_pixels" | awk '
    NF != 15 { exit 1 }
    { wall_x = ($2 + $4) / 2; wall_y = ($3 + $5) / 2
      open_x = ($7 + $9) / 2; open_y = ($8 + $10) / 2
      beyond_x = ($12 + $14) / 2; beyond_y = ($13 + $15) / 2
      past = (open_x - wall_x) * (beyond_x - open_x) + (open_y - wall_y) * (beyond_y - open_y)
      exit !($1 > 200 && $4 - $2 > 150 && $5 - $3 > 40 && $6 > 40 && $6 < $1 && $11 > 5 &&
             $11 < $6 && past > 0) }'
}

# shows_no_map: whether not a pixel of walls or open edges is seen.
shows_no_map() {
  map_pixels
  [ "$(head -2 "$scratch/map_pixels" | paste -s -d ' ')" = "0 0" ]
}
