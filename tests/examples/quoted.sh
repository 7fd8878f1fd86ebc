#!/usr/bin/env bash
# quoted.sh PAGE SOURCE...: every part of a source between `// begin: NAME` and `// end` stands in the
# page, line by line, but for its indentation.
set -euo pipefail
page=$1
shift
awk '
  { sub(/^ +/, "") }
  FILENAME == ARGV[1] { text = text $0 "\n"; next }
  /^\/\/ begin: / { part = ""; name = $3; next }
  /^\/\/ end$/ {
    parts++
    if (!index(text, "\n" part)) { print FILENAME ": not quoted by the page as it is: " name; bad = 1 }
    name = ""
    next
  }
  name { part = part $0 "\n" }
  END { if (!parts) print "no part to be quoted"; exit bad || !parts }
' "$page" "$@"
