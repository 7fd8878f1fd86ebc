#!/usr/bin/env bash
# make_packages.sh: on a system that may be changed, makes the Debian packages, asks lintian about
# them (no errors), and leaves them in /out. Run by: tests/on_debian.sh RELEASE packages
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bash cmake/install-debian-packages.sh
DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends file lintian

cmake --preset package
cmake --build --preset package --parallel "$(nproc)"
cd build-package
rm -f ./*.deb
cpack -G DEB
ls -l ./*.deb
# On testing nobody may know yet which release is the current one; of the changelog no error either.
lintian --allow-root --fail-on error ./*.deb
cp ./*.deb /out/
