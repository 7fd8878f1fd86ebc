#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// An edge of a ring or of a wall beyond; `kind` as drawn: '#' wall, '?' open, 'b' wall beyond.
struct TracedEdge {
  TPoint2D a;
  TPoint2D b;
  char kind;
};

std::vector<TracedEdge> edgesOf(const PolygonMap& map);

double distance(const TPoint2D& p, const TracedEdge& edge);
double distance(const TPoint2D& p, const std::vector<TracedEdge>& edges);

/// What traceBitmap() is to see: a bitmap whose free components of less than the given number of
/// cells are unknown. Found by flooding, cell by cell.
struct FloodedBitmap {
  OccupancyBitmap bitmap;
  int component_count = 0;
  std::size_t free_cells = 0;
};
FloodedBitmap floodComponents(OccupancyBitmap bitmap, std::size_t min_cells);

/// Cell sides of each kind, counted in the bitmap.
struct SideCounts {
  std::size_t wall = 0;
  std::size_t open = 0;
  std::size_t beyond = 0;
};
SideCounts countSides(const OccupancyBitmap& bitmap);

/// Says which pair of edges crosses, overlaps or touches other than in a common end (all pairs are
/// looked at); empty if none. For maps with integer coordinates: exact.
std::string findCrossing(const PolygonMap& map);

/// Says which ring has a vertex twice, fewer than three or no area, or lies outside its polygon;
/// empty if none.
std::string findBadRing(const PolygonMap& map);

}  // namespace mrpt_polyloc::test
