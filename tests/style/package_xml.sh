#!/usr/bin/env bash
# package_xml.sh ROOT: what ROOT's CMake files look for has its key of rosdep in package.xml, every
# dependency in package.xml is looked for, and no key is unknown to this test, which got them from
# rosdep/base.yaml and rosdep/python.yaml of ros/rosdistro, and mrpt_lib* from its distributions.
set -euo pipefail
cd "$1"

# What CMake calls it, then the key.
keys='
Boost libboost-dev
CGAL cgal
CLI11 cli11
Eigen3 eigen
GTest gtest
GTest google-mock
PNG libpng-dev
PkgConfig pkg-config
TBB tbb
ZLIB zlib
benchmark benchmark
cpp-httplib libcpp-httplib-dev
fftw3f libfftw3
gmp libgmp
mpfr mpfr
nlohmann_json nlohmann-json-dev
openssl libssl-dev
python3 python3
yaml-cpp yaml-cpp
zstd libzstd-dev
mrpt-containers mrpt_libbase
mrpt-img mrpt_libopengl
mrpt-io mrpt_libbase
mrpt-maps mrpt_libmaps
mrpt-math mrpt_libmath
mrpt-obs mrpt_libobs
mrpt-opengl mrpt_libopengl
mrpt-poses mrpt_libposes
mrpt-random mrpt_libbase
mrpt-serialization mrpt_libbase
mrpt-slam mrpt_libslam
mrpt-system mrpt_libbase
'

# Calls in the CMake files that this build reads; comments are cut off, and calls joined to a line.
calls=$(find CMakeLists.txt mrpt_polyloc apps tests cmake \
  \( -name CMakeLists.txt -o -name '*.cmake' \) -not -path 'tests/package/*' \
  -not -name PolylocMrpt.cmake -print0 | xargs -0 sed 's/#.*//' | tr '\n' ' ' | tr ')' '\n')
wanted=$({
  # Threads is of the C library.
  sed -nE 's/.*find_package\( *([A-Za-z0-9_-]+).*/\1/p' <<< "$calls" | grep -vx Threads
  sed -nE 's/.*pkg_check_modules\( *[A-Z0-9_]+ (.*)/\1/p' <<< "$calls" | tr ' ' '\n' |
    grep -vxE 'REQUIRED|IMPORTED_TARGET|GLOBAL|' | sed 's/[<>=].*//'
  sed -nE 's/.*polyloc_require_mrpt\( *(.*)/\1/p' <<< "$calls" | tr ' ' '\n' | grep . | sed 's/^/mrpt-/'
  sed -nE 's/.*find_program\( *[A-Z0-9]+ (python3).*/\1/p' <<< "$calls"
  # Linked by their bare names.
  printf '%s\n' gmp mpfr
} | sort -u)
stated=$(sed -nE 's/.*<(build_|exec_|test_|)depend>([^<]*)<.*/\2/p' package.xml | sort)

failed=0
complain() {
  echo "package.xml: $1"
  failed=1
}
needed=
for name in $wanted; do
  found=$(awk -v name="$name" '$1 == name { print $2 }' <<< "$keys")
  if [ -z "$found" ]; then complain "CMake looks for $name, of which no key is known here"; fi
  needed+="$found"$'\n'
done
needed=$(sort -u <<< "$needed" | grep .)
for key in $(comm -23 <(echo "$needed") <(sort -u <<< "$stated")); do
  complain "no dependency $key, which CMake looks for"
done
for key in $(comm -13 <(echo "$needed") <(sort -u <<< "$stated")); do
  complain "a dependency $key, which CMake does not look for"
done
for key in $(uniq -d <<< "$stated"); do complain "the dependency $key twice"; done
exit "$failed"
