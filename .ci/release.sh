#!/usr/bin/env bash
# release.sh [--check] VERSION: makes a release of what is committed: refuses where changelog, version
# and tags disagree, then runs the demo, the tests and the packages on a clean system of each release
# of Debian (root; hours), and sets the tag vVERSION. --check: only looks whether they agree.
#
# They agree where
#   package.xml, from which CMake and the programs have it, states VERSION;
#   CHANGELOG.md has the heading `## [VERSION] - YYYY-MM-DD`, the first one after `## [Unreleased]`,
#   with something below it, and nothing between the two;
#   VERSION is greater than that of every tag, or its tag is this commit's;
#   all is committed.
set -euo pipefail
fail() {
  echo "release.sh: $1" >&2
  exit 1
}
check_only=
if [ "${1-}" = --check ]; then
  check_only=1
  shift
fi
version=${1-}
if [ $# -ne 1 ] || ! [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]; then
  echo "usage: release.sh [--check] MAJOR.MINOR.PATCH" >&2
  exit 2
fi
cd "${POLYLOC_RELEASE_ROOT:-$(dirname "${BASH_SOURCE[0]}")/..}"

[ -z "$(git status --porcelain)" ] || fail "there are changes that are not committed"

stated=$(sed -nE 's/.*<version>([^<]*)<.*/\1/p' package.xml)
[ "$stated" = "$version" ] || fail "package.xml states version $stated, not $version"

headings=$(grep -E '^## ' CHANGELOG.md)
[ "$(sed -n 1p <<< "$headings")" = "## [Unreleased]" ] ||
  fail "the first heading of CHANGELOG.md is not '## [Unreleased]'"
heading=$(sed -n 2p <<< "$headings")
[[ $heading =~ ^"## [$version] - "[0-9]{4}-[0-9]{2}-[0-9]{2}$ ]] ||
  fail "CHANGELOG.md has '$heading' where '## [$version] - YYYY-MM-DD' is expected"
# below HEADING: the lines up to the next heading that say something.
below() {
  awk -v heading="$1" '$0 == heading { on = 1; next } /^## / { on = 0 } on && /^[^#]/' CHANGELOG.md
}
[ -z "$(below "## [Unreleased]")" ] || fail "CHANGELOG.md has changes that are not released"
[ -n "$(below "$heading")" ] || fail "CHANGELOG.md says nothing of $version"

tag=v$version
if git rev-parse -q --verify "refs/tags/$tag" > /dev/null; then
  [ "$(git rev-parse "$tag^{commit}")" = "$(git rev-parse HEAD)" ] ||
    fail "the tag $tag is another commit's"
else
  for other in $(git tag -l 'v[0-9]*'); do
    [ "$(printf '%s\n' "${other#v}" "$version" | sort -V | tail -1)" = "$version" ] ||
      fail "there is the tag $other of a later version"
  done
fi
echo "changelog, version and tags agree on $version"
[ -z "$check_only" ] || exit 0

for release in bookworm trixie forky; do
  for what in demo tests packages; do
    bash tests/on_debian.sh "$release" "$what" || fail "$what failed on $release"
  done
done
git rev-parse -q --verify "refs/tags/$tag" > /dev/null || git tag -a "$tag" -m "mrpt_polyloc $version"
echo "released $version: git push origin $tag"
