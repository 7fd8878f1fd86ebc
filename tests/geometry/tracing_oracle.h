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

std::vector<TracedEdge> tracedEdges(const PolygonMap& map);

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

/// Says which pair of edges crosses, overlaps or touches other than in a common end; empty if none.
/// Exact for coordinates that are integers or halves. All pairs are looked at.
std::string findCrossing(const PolygonMap& map);

/// The same for large maps: looks at the pairs of edges whose boxes share a square of the given
/// side.
std::string findCrossingInSquares(const PolygonMap& map, double side);

/// Says which ring has a vertex twice, fewer than three or no area, or lies outside its polygon;
/// empty if none.
std::string findBadRing(const PolygonMap& map);

/// Which cell centres lie in the free space of a map traced from a bitmap of cells of 1 m at the
/// origin, by scan lines; row by row.
std::vector<bool> freeCentres(const PolygonMap& map, int width, int height);

}  // namespace mrpt_polyloc::test
