#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc {

/// A map as it is drawn at some scale: its lines by what they are, with fewer vertices [m].
struct POLYLOC_EXPORT MapOutline {
  std::vector<Polyline> free;    ///< rings of the free space, closed; filled by the even-odd rule
  std::vector<Polyline> walls;   ///< chains of wall edges; a ring that is all walls is one closed
  std::vector<Polyline> open;    ///< chains of open edges
  std::vector<Polyline> beyond;  ///< walls beyond
};

/// Simplified by Douglas and Peucker's method, each chain of one kind by itself: a vertex that is
/// left out lies within the tolerance of the line that replaces it, and ends of chains stay. Rings
/// and walls beyond that fit into a square of the tolerance are left out. Lines may cross each
/// other by the tolerance: to be drawn, not to be searched.
/// \param tolerance [m]; 0: all vertices \throws InvalidParamsError if it is negative or not finite
POLYLOC_EXPORT MapOutline outlineOf(const PolygonMap& map, double tolerance);

}  // namespace mrpt_polyloc
