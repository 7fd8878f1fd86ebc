#!/usr/bin/env bash
# docs_columns.sh ROOT: no line of the documentation is longer than 100 columns. Rows of tables and
# pictures, which Markdown cannot break, are left out.
set -euo pipefail
cd "$1"
failed=0
while IFS= read -r file; do
  awk -v file="$file" '
    length($0) > 100 && !/^ *\|/ && !/^!\[/ { print file ":" FNR ": " length($0) " columns"; bad = 1 }
    END { exit bad }' "$file" || failed=1
done < <(find . -name '*.md' -not -path './build*' -not -path './.git/*' | sort)
exit "$failed"
