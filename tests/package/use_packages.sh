#!/usr/bin/env bash
# use_packages.sh: on a clean system that may be changed, installs the Debian packages of /out, uses
# the programs, builds another project against the library, and removes all of it again, to the last
# file. Run by: tests/on_debian.sh RELEASE packages
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export DEBIAN_FRONTEND=noninteractive
get() { apt-get -q -y -o Dpkg::Use-Pty=0 "$@"; }
fail() {
  echo "use_packages.sh: $1" >&2
  exit 1
}

echo "== install library and programs"
get update
get install --no-install-recommends /out/libmrpt-polyloc0.*.deb /out/mrpt-polyloc-apps_*.deb
version=$(dpkg-query -W -f '${Version}' mrpt-polyloc-apps)
if dpkg-query -W -f '${db:Status-Status} ${Package}\n' | grep -q '^installed lib.*-dev$'; then
  fail "the programs need development packages"
fi

echo "== use the programs"
programs=$(dpkg -L mrpt-polyloc-apps | grep '^/usr/bin/')
[ "$(wc -l <<< "$programs")" -eq 9 ] || fail "these are not the nine programs: $programs"
for program in $programs; do
  name=$(basename "$program")
  [ "$("$program" --version)" = "$name ${version%-*}" ] || fail "$name does not tell its version"
  zcat "/usr/share/man/man1/$name.1.gz" | grep -q '^\.SH NAME' || fail "$name has no manual page"
  bash -euc ". /usr/share/bash-completion/completions/$name; complete -p $name" > /dev/null
done
examples=/usr/share/doc/mrpt-polyloc-apps/examples
polyloc-map "$examples/niches.wkt" --check
polyloc-localize --method exact --map "$examples/niches.wkt" --scans "$examples/niches_query.wkt"
work=$(mktemp -d)
polyloc-simulate --map "$examples/niches.wkt" -n 3 --seed 1 -o "$work/simulated"
polyloc-eval --map "$examples/niches.wkt" --scans "$work/simulated/scans.rawlog" \
  --truth "$work/simulated/truth.tum" -o "$work/eval"
grep -q '"scans": 3' "$work/eval/summary.json" || fail "polyloc-eval did not count three scans"

echo "== build against the library"
get install --no-install-recommends /out/libmrpt-polyloc-dev_*.deb cmake ninja-build g++
headers=$(dpkg -L libmrpt-polyloc-dev | grep -c '\.h$')
cmake -S "$project/tests/package/consumer" -B "$work/consumer" -G Ninja \
  -DEXPECTED_VERSION="${version%-*}" -DEXPECTED_PREFIX=/usr -DEXPECTED_HEADERS="$headers" \
  -DCMAKE_PREFIX_PATH=/usr
cmake --build "$work/consumer" --target consumer
"$work/consumer/consumer"

echo "== remove"
packages=$(dpkg-query -W -f '${Package}\n' | grep -E '^(lib)?mrpt-polyloc')
[ "$(wc -l <<< "$packages")" -eq 3 ] || fail "these are not the three packages: $packages"
files=$(for package in $packages; do dpkg -L "$package"; done | grep -E 'polyloc' | sort -u)
# shellcheck disable=SC2086 # three words
get purge $packages
for file in $files; do
  [ ! -e "$file" ] || fail "left behind: $file"
done
if ldconfig -p | grep polyloc; then fail "the loader still knows of the library"; fi
echo "packages made, installed, used and removed: $(tr '\n' ' ' <<< "$packages")$version"
