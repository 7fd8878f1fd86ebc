#pragma once

#include <mrpt_polyloc/geometry/findings.h>

#include <vector>

namespace mrpt_polyloc {

/// A ring that is fit for a look at crossings: finite, at least three vertices, neither repeated
/// vertices nor spikes, some area, counterclockwise (by the sign of its area) whatever its role.
struct CleanRing {
  Ring ring;
  int polygon = 0;  ///< index into RawMap::polygons
  bool is_outer = true;
};

/// The clean rings of all polygons, an outer ring before its holes. Reports repeated vertices,
/// spikes, rings of too few vertices or zero area, and coordinates that cannot be used.
std::vector<CleanRing> cleanRings(const std::vector<RawPolygon>& polygons, Findings& findings);

/// The walls beyond without repeated points and without walls of no length.
std::vector<Polyline> cleanWalls(const std::vector<Polyline>& walls, Findings& findings);

/// The same ring run through the other way, from the same first vertex.
Ring reversed(const Ring& ring);

}  // namespace mrpt_polyloc
