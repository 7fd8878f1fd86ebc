#!/usr/bin/env bash
# package_round_trip.sh RELEASE: makes the Debian packages on a clean Debian (bookworm, trixie or
# forky), and installs, uses and removes them on another one. See on_debian.sh for what it needs.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: package_round_trip.sh bookworm|trixie|forky" >&2; exit 2; }
exec bash "$(dirname "${BASH_SOURCE[0]}")/on_debian.sh" "$1" packages
