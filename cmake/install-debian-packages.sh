#!/usr/bin/env bash
# install-debian-packages.sh [tests]: installs what building mrpt_polyloc needs on Debian 12, 13 or
# testing, with `tests` also what its tests and benchmarks need. Does nothing, and needs no rights,
# where all of it is there.
set -euo pipefail

# Only the parts of MRPT that are linked: libmrpt-dev would bring 500 packages more. mrpt-common
# holds the data of MRPT's demos.
packages=(
  build-essential cmake ninja-build ccache pkg-config
  libmrpt-maps-dev libmrpt-obs-dev libmrpt-img-dev libmrpt-io-dev libmrpt-slam-dev mrpt-common
  libcgal-dev libgmp-dev libmpfr-dev libboost-dev libeigen3-dev
  nlohmann-json3-dev libcli11-dev libtbb-dev libfftw3-dev zlib1g-dev
  libpng-dev libyaml-cpp-dev libzstd-dev libcpp-httplib-dev libssl-dev
)
case "${1-}" in
  "") ;;
  # mrpt-apps: programs that load this library; their windows open in xvfb, drawn by software. The
  # slam library is for an example alone. chromium: the page of polyloc-view is tested in it; where
  # it cannot be had, those tests are skipped by name.
  tests)
    packages+=(
      libgtest-dev libgmock-dev libbenchmark-dev libmrpt-slam-dev
      mrpt-apps xvfb xdotool libgl1-mesa-dri parallel python3 locales
    )
    # The one version that the sources are formatted with. Later releases of Debian do not have it;
    # the test style.clang_format is skipped there.
    if grep -qs '^VERSION_CODENAME=bookworm$' /etc/os-release; then
      packages+=(clang-format-14)
    fi
    # Not on every architecture.
    if apt-cache show chromium-driver > /dev/null 2>&1; then
      packages+=(chromium chromium-driver)
    fi
    ;;
  *)
    echo "usage: install-debian-packages.sh [tests]" >&2
    exit 2
    ;;
esac

if ! command -v apt-get > /dev/null; then
  echo "$0: no apt-get here; install the equivalents of: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=(env)
elif command -v sudo > /dev/null; then
  as_root=(sudo env)
else
  echo "$0: missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
  exit 1
fi
apt_get=("${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600)
echo "installing ${missing[*]}"
"${apt_get[@]}" update
"${apt_get[@]}" install --no-install-recommends "${missing[@]}"
