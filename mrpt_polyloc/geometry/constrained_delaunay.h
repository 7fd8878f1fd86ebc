#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// The vertices and faces of Triangulation: the constrained Delaunay triangulation of `box` with
/// all edges and walls beyond of the map as constraints. Constraints may touch, overlap and cross
/// (a crossing becomes a vertex, rounded to double); where a wall and an open edge overlap, the
/// wall counts. O(n log n) for maps as they occur. \throws InvalidMapError if the triangulation
/// fails (coordinates too large for double arithmetic).
std::pair<std::vector<TPoint2D>, std::vector<Triangulation::Face>> constrainedDelaunay(
    const PolygonMap& map, const BoundingBox& box);

}  // namespace mrpt_polyloc
