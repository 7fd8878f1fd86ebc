#!/usr/bin/env bash
# man_page_formats.sh AWK: what CLI11 2.3 and 2.6 print of one program gives one manual page, word by
# word.
set -euo pipefail
words() { awk -v name=polyloc-demo -v version=1 -v date=today -f "$1" | tr -s ' \n' '\n'; }

diff <(words "$1" << 'HELP'
Shows a map in the browser: place a robot in it.
Usage: polyloc-demo [OPTIONS] MAP

Positionals:
  MAP TEXT REQUIRED                 The map

Options:
  -h,--help                         Print this help message and exit
  --strict                          Refuse a log
HELP
) <(sed 's/_$/ /' << 'HELP' | words "$1"
Shows a map in the browser: place_
a robot in it._


polyloc-demo [OPTIONS] MAP


POSITIONALS:
  MAP TEXT REQUIRED                 The map_

OPTIONS:
  -h,     --help                    Print this help message and exit_
          --strict                  Refuse a log_
HELP
)
