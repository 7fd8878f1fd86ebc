#!/usr/bin/env bash
# symbols.sh LIBRARY: what the shared library shows is its own and what is marked for it: nothing of
# the libraries inside, which a host that loads it may use in another version; no internals.
set -euo pipefail
symbols=$(nm -D --defined-only "$1" | c++filt)
count=$(wc -l <<< "$symbols")
echo "$count symbols"
failed=0
if grep -E '\b(CGAL|boost|nlohmann|YAML|tbb|Eigen|std)::' <<< "$symbols" | grep -v 'mrpt_polyloc::'; then
  echo "symbols of other libraries are seen from outside" >&2
  failed=1
fi
# But for resolvers of functions compiled for several processors, which g++ 12 does not hide.
if grep -v -e ' i ' -e 'clone .resolver' <<< "$symbols" |
  grep -E 'mrpt_polyloc::(TreeDescent|RangeBandFinder|SquareExpander|boundCosts)\b'; then
  echo "internals are seen from outside" >&2
  failed=1
fi
if ! grep -q 'mrpt_polyloc::GlobalLocalizer::localize' <<< "$symbols"; then
  echo "the interface is not seen from outside" >&2
  failed=1
fi
if [ "$count" -gt 900 ]; then
  echo "more than 900 symbols are seen from outside" >&2
  failed=1
fi
exit "$failed"
