#!/usr/bin/env bash
# release_selftest.sh ROOT: .ci/release.sh --check takes a project whose changelog, version and tags
# agree, and refuses each way in which they do not.
set -euo pipefail
script=$1/.ci/release.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export POLYLOC_RELEASE_ROOT=$work GIT_CONFIG_GLOBAL=/dev/null
export GIT_AUTHOR_NAME=x GIT_AUTHOR_EMAIL=x@x GIT_COMMITTER_NAME=x GIT_COMMITTER_EMAIL=x@x
git -C "$work" init -q

# project VERSION CHANGELOG: commits such a project.
project() {
  printf '<package>\n  <version>%s</version>\n</package>\n' "$1" > "$work/package.xml"
  printf '%b' "$2" > "$work/CHANGELOG.md"
  git -C "$work" add -A
  git -C "$work" commit -q --allow-empty -m x
}
# refused REASON: what release.sh --check 1.2.0 has to say.
refused() {
  local said
  if said=$(bash "$script" --check 1.2.0 2>&1); then
    echo "taken, though: $1" >&2
    exit 1
  fi
  grep -qF -- "$1" <<< "$said" || { echo "said: $said; wanted: $1" >&2; exit 1; }
}
good='# Changelog\n## [Unreleased]\n\n## [1.2.0] - 2026-12-01\n### Added\n- A thing.\n\n## [1.1.0] - 2026-01-01\n- Old.\n'

project 1.2.0 "$good"
bash "$script" --check 1.2.0 > /dev/null
git -C "$work" tag v1.1.0
git -C "$work" tag v1.2.0
bash "$script" --check 1.2.0 > /dev/null
touch "$work/new"
refused "not committed"
rm "$work/new"
project 1.2.0 "$good"
refused "another commit's"
git -C "$work" tag -d v1.2.0 > /dev/null
git -C "$work" tag v1.10.0
refused "v1.10.0 of a later version"
git -C "$work" tag -d v1.10.0 > /dev/null
project 1.2.1 "$good"
refused "package.xml states version 1.2.1"
project 1.2.0 "${good/1.2.0/1.3.0}"
refused "'## [1.2.0] - YYYY-MM-DD' is expected"
project 1.2.0 "${good/ - 2026-12-01/}"
refused "'## [1.2.0] - YYYY-MM-DD' is expected"
project 1.2.0 "${good/'Unreleased]'/'Unreleased]\n- Late.'}"
refused "not released"
project 1.2.0 "${good/- A thing.\\n/}"
refused "says nothing of 1.2.0"
project 1.2.0 "${good/'[Unreleased]'/Unreleased}"
refused "the first heading"
