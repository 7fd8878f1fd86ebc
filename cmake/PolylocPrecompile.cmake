# Headers that nearly every file includes and that take most of the time to compile, read once per
# target. For gates, which compile everything anew; off by default, as a file that lacks an include
# is not found out with it, and a compiler cache does less. Not for the library, some files of which
# are compiled with options of their own.
option(POLYLOC_PRECOMPILE "Precompile the common headers of tests" OFF)

function(polyloc_precompile target)
  if(NOT POLYLOC_PRECOMPILE)
    return()
  endif()
  target_precompile_headers(
    ${target}
    PRIVATE
    <algorithm>
    <cmath>
    <functional>
    <map>
    <memory>
    <string>
    <vector>
    <Eigen/Dense>
    <mrpt/math/CMatrixFixed.h>
    <mrpt/math/TPoint2D.h>
    <mrpt/math/TPose2D.h>
    ${ARGN})
endfunction()
