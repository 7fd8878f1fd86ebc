#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

namespace mrpt_polyloc::test {

/// A room of 6 m x 4 m that lacks its upper corners, with a pillar of three corners.
inline PolygonMap pillarRoom() {
  return PolygonMap(
      {{wallRing({{0, 0}, {6, 0}, {6, 3}, {4.5, 3}, {4.5, 4}, {1, 4}, {1, 3}, {0, 3}}),
        {wallRing({{2, 1}, {2.7, 2}, {3, 1.2}})}}});
}

}  // namespace mrpt_polyloc::test
