#!/usr/bin/env bash
# on_debian.sh RELEASE [demo|tests|packages]: runs a command of the README (demo: apps/demo.sh, the
# default; tests: tests/run.sh) on a clean Debian of that release: bookworm, trixie or forky. It
# finds what a newcomer would meet and what this machine hides because something is installed here
# by chance. packages: makes the Debian packages on one such system, then installs, uses and removes
# them on another, see tests/package/.
#
# Needs root and debootstrap. The bare system is made once and kept in
# ${XDG_CACHE_HOME:-$HOME/.cache}/mrpt_polyloc-debian, or in the folder that POLYLOC_DEBIAN_CACHE
# names, with the downloaded packages and ccache's files beside it; remove it all for a fresh start.
# The command runs in a copy of the bare system, on a copy of the files that git tracks here, with
# their uncommitted changes. POLYLOC_DATA, if set, is passed through, read-only, and so is
# POLYLOC_WERROR. Packages come from where this machine's come from.
#
# The copy is removed at the end, also when interrupted. Its mounts live in a mount namespace of
# their own, which ends with its last process, so none can be left behind.
# Exit: that of the command; 1 where it could not be run; 2 for wrong usage.
set -euo pipefail

usage() {
  echo "usage: on_debian.sh bookworm|trixie|forky [demo|tests|packages]" >&2
  exit 2
}

fail() {
  echo "on_debian.sh: $1" >&2
  exit 1
}

if [ $# -lt 1 ] || [ $# -gt 2 ]; then usage; fi
release=$1
case "$release" in
  bookworm | trixie | forky) ;;
  *) usage ;;
esac
case "${2-demo}" in
  demo) commands=(apps/demo.sh) ;;
  tests) commands=(tests/run.sh) ;;
  packages) commands=(tests/package/make_packages.sh tests/package/use_packages.sh) ;;
  *) usage ;;
esac
[ "$(id -u)" -eq 0 ] || fail "needs root, to make a system and enter it"
for program in debootstrap git unshare; do
  command -v "$program" > /dev/null || fail "needs $program"
done
data=${POLYLOC_DATA-}
if [ -n "$data" ]; then
  data=$(cd "$data" && pwd) || fail "POLYLOC_DATA names no folder"
fi

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${POLYLOC_DEBIAN_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/mrpt_polyloc-debian}
base=$cache/$release
packages=$cache/packages-$release
ccache=$cache/ccache-$release
mkdir -p "$packages/partial" "$ccache"

root= # the folder that is removed at the end
out=  # another: what one command leaves for the next
job=  # the process that is ended before

# Ends the job, then removes its folder. Again after a second, if a process on its way out still
# wrote there.
clean_up() {
  trap '' HUP INT TERM
  if [ -n "$job" ]; then
    kill -KILL "$job" 2> /dev/null || true
    wait "$job" 2> /dev/null || true
  fi
  if [ -n "$root" ]; then
    rm -rf "$root" 2> /dev/null || { sleep 1 && rm -rf "$root"; }
  fi
  if [ -n "$out" ]; then rm -rf "$out"; fi
}
trap clean_up EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

# isolated COMMAND...: runs it where its mounts and processes are its own and end with it. In the
# background, for bash would put off a trap until a command in the foreground has ended.
isolated() {
  local status=0
  unshare --mount --pid --fork --kill-child "$@" < /dev/null &
  job=$!
  wait "$job" || status=$?
  job=
  return "$status"
}

# The mirror of Debian that this machine uses: the first address of an archive named `debian`.
mirror() {
  cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources \
    2> /dev/null | awk '
      /^deb / { sub(/\[[^]]*\]/, ""); address = $2 }
      /^URIs:/ { address = $2 }
      address ~ /^https?:.*\/debian\/?$/ { print address; exit }' || true
}

if [ ! -d "$base" ]; then
  echo "== make a bare $release"
  from=$(mirror)
  # A debootstrap that is older than the release still knows sid, which is made in the same way.
  script=/usr/share/debootstrap/scripts/$release
  [ -e "$script" ] || script=/usr/share/debootstrap/scripts/sid
  root=$(mktemp -d "$cache/new-$release-XXXXXX")
  chmod 755 "$root"
  isolated debootstrap --variant=minbase "$release" "$root" \
    "${from:-http://deb.debian.org/debian}" "$script" > "$cache/$release.log" 2>&1 ||
    fail "debootstrap failed; its log: $cache/$release.log"
  mv "$root" "$base"
  root=
fi

# make_root: a copy of the bare system with the project in it.
make_root() {
  echo "== copy the bare $release and the project"
  root=$(mktemp -d "$cache/run-$release-XXXXXX")
  cp -a "$base/." "$root"
  # Names are looked up and packages fetched as on this machine.
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  apt-config dump | grep -E '^Acquire::(https?::Proxy|Check-Date|Check-Valid-Until) ' \
    > "$root/etc/apt/apt.conf.d/99as-outside" || true
  # The copy is thrown away: nothing in it must outlast a loss of power.
  echo force-unsafe-io > "$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
  mkdir "$root/ccache" "$root/data" "$root/out" "$root/mrpt_polyloc"
  # A tracked file that is gone from the work tree is left out.
  git -c safe.directory="$project" -C "$project" ls-files -z |
    while IFS= read -r -d '' file; do
      if [ -e "$project/$file" ]; then printf '%s\0' "$file"; fi
    done | tar -C "$project" --null -T - -c | tar -C "$root/mrpt_polyloc" -x
}

environment=(
  PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
  HOME=/root LANG=C.UTF-8 CCACHE_DIR=/ccache
  ${POLYLOC_WERROR:+"POLYLOC_WERROR=$POLYLOC_WERROR"}
  ${data:+POLYLOC_DATA=/data}
)

# enter ROOT PACKAGES CCACHE OUT DATA COMMAND...: mounts what the system needs below ROOT, and runs
# COMMAND in it.
enter() {
  local root=$1 packages=$2 ccache=$3 out=$4 data=$5
  shift 5
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys"
  mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
  mount -t tmpfs -o mode=1777 tmpfs "$root/dev/shm"
  mount --bind "$packages" "$root/var/cache/apt/archives"
  mount --bind "$ccache" "$root/ccache"
  mount --bind "$out" "$root/out"
  if [ -n "$data" ]; then
    mount --bind "$data" "$root/data"
    mount -o remount,bind,ro "$root/data"
  fi
  exec chroot "$root" env -i "$@"
}

out=$(mktemp -d "$cache/out-$release-XXXXXX")
chmod 755 "$out"
for command in "${commands[@]}"; do
  make_root
  echo "== $release: $command"
  isolated bash -euo pipefail -c "$(declare -f enter); enter \"\$@\"" enter \
    "$root" "$packages" "$ccache" "$out" "$data" "${environment[@]}" bash "/mrpt_polyloc/$command"
  rm -rf "$root"
  root=
done
