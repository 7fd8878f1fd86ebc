#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc::test {

/// Twice the area over the perimeter: about the width, of a thin cell too.
inline double widthOf(const std::vector<TPoint2D>& polygon) {
  double perimeter = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    perimeter += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return 2.0 * signedArea(polygon) / perimeter;
}

}  // namespace mrpt_polyloc::test
