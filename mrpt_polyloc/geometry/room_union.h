#pragma once

#include <mrpt_polyloc/geometry/validation.h>

namespace mrpt_polyloc {

/// Polygons that overlap or share edges, as floor plans have a polygon for each room and door,
/// united: where two rooms share an edge there is no wall between them, and a door that overlaps
/// two rooms joins them. Polygons are read with any orientation; crossing rings within one polygon
/// are not repaired. Walls beyond are kept; all edges of the result are walls.
///
/// By Boost.Geometry, whose result is not exact: check it with inspectMap(). O(n log n) a level,
/// log of the number of polygons levels.
RawMap uniteRooms(const RawMap& raw);

}  // namespace mrpt_polyloc
