#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/BoundingBox.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What an edge of free space borders on: a wall stops a beam; past an open edge lies unknown
/// space, and a beam may go on into it.
enum class EdgeKind : std::uint8_t { wall, open };

/// A closed chain of vertices [m]. `kinds[i]` belongs to the edge from vertex i to vertex i + 1
/// (the last one closes the ring), so both have one size. The first vertex is not repeated.
struct POLYLOC_EXPORT Ring {
  std::vector<TPoint2D> vertices;
  std::vector<EdgeKind> kinds;

  std::size_t size() const { return vertices.size(); }
};

/// A ring whose edges are all walls.
POLYLOC_EXPORT Ring wallRing(std::vector<TPoint2D> vertices);

/// Twice the signed area is the shoelace sum; this is the area itself [m2], positive for
/// counterclockwise.
POLYLOC_EXPORT double signedArea(const std::vector<TPoint2D>& vertices);

/// One connected piece of free space: the outer ring counterclockwise, the holes clockwise, so
/// that free space lies to the left of every directed edge.
struct POLYLOC_EXPORT FreePolygon {
  Ring outer;
  std::vector<Ring> holes;
};

/// An open chain of at least two points [m].
using Polyline = std::vector<TPoint2D>;

/// The map: free space as polygons with holes (several components allowed), every edge a wall or
/// open, and the *walls beyond*: walls known to stand outside the free space, behind unknown cells.
///
/// Immutable. All coordinates are metres in the map frame.
class POLYLOC_EXPORT PolygonMap {
 public:
  /// Takes rings as they are after validation (see repairMap()): at least three vertices, finite
  /// coordinates, outer rings counterclockwise, holes clockwise, `kinds` as long as `vertices`.
  /// \throws InvalidMapError naming the ring and coordinate if one of these does not hold, or if
  /// there is no component (no free space). Crossings are *not* looked for here.
  /// \param cell_size see cellSize()
  explicit PolygonMap(std::vector<FreePolygon> components, std::vector<Polyline> walls_beyond = {},
                      double cell_size = 0.0);

  const std::vector<FreePolygon>& components() const { return components_; }
  const std::vector<Polyline>& wallsBeyond() const { return walls_beyond_; }

  /// All rings, component by component, outer ring first.
  std::vector<const Ring*> rings() const;

  /// Of the free space and the walls beyond.
  const BoundingBox& boundingBox() const { return bounding_box_; }

  /// Whether a point is in free space or on its border. O(n); for many points use Triangulation.
  bool contains(const TPoint2D& point) const;

  std::size_t vertexCount() const;
  /// Vertices whose angle, measured in free space, exceeds pi.
  std::size_t reflexVertexCount() const;
  std::size_t holeCount() const;
  double area() const;               ///< of the free space [m2]
  double perimeter() const;          ///< of all rings [m]
  double openPerimeter() const;      ///< of the open edges [m]
  double wallsBeyondLength() const;  ///< [m]

  /// Side of the grid cells that the map was traced from [m], 0 if it was drawn: walls are known no
  /// better than that.
  double cellSize() const { return cell_size_; }

  /// A 64-bit FNV-1a hash of all coordinates and kinds: equal maps, equal hash. Used to tie an
  /// index file to its map, of which it holds where things are, not how well that is known.
  std::uint64_t hash() const;

 private:
  std::vector<FreePolygon> components_;
  std::vector<Polyline> walls_beyond_;
  BoundingBox bounding_box_;
  double cell_size_;
};

}  // namespace mrpt_polyloc
