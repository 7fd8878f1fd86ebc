#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <vector>

namespace mrpt_polyloc {

/// The thickest wall that a door leads through [m]: thicker ones are of castles and of plans in
/// another unit.
constexpr double kThickestDoorWall = 0.5;

/// Passages of free space where doors, drawn as lines, lie in or along the wall between two rooms:
/// a rectangle for each part of a door, as wide as the door is, that reaches a little into the
/// rooms on both sides. A door without a room on both sides within kThickestDoorWall (both
/// distances together) has none, nor has one that lies in a room. O(n) for each door.
///
/// \param rooms with any orientation of rings \param doors lines along the wall [m]
POLYLOC_EXPORT std::vector<RawPolygon> doorPassages(const std::vector<RawPolygon>& rooms,
                                                    const std::vector<Polyline>& doors);

}  // namespace mrpt_polyloc
