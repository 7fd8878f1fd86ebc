#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace mrpt_polyloc {

/// Finds the nearest wall of a map, walls beyond included, open edges not: an R-tree of its edges.
/// Immutable and thread-safe; copies share the tree.
class NearestWalls {
 public:
  /// The point of a wall that is nearest to another.
  struct Nearest {
    TPoint2D point;
    double squared_distance;  ///< [m2]
    std::uint32_t wall;       ///< number of the edge, rings first, then walls beyond
  };

  explicit NearestWalls(const PolygonMap& map);

  /// None for a map without walls, or a point that is not finite. About O(log n).
  std::optional<Nearest> nearest(const TPoint2D& point) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace mrpt_polyloc
