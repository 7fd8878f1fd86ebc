#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace mrpt_polyloc::test {

/// A line segment that nothing is seen through.
using Segment = std::pair<TPoint2D, TPoint2D>;

/// All borders of a map, open ones too: what is seen of free space ends there.
std::vector<Segment> borders(const PolygonMap& map);
/// All walls of a map, those beyond too, and a box around.
std::vector<Segment> wallsAndBox(const PolygonMap& map, const BoundingBox& box);

/// Visibility polygons by CGAL's triangular expansion with exact numbers: the oracle.
class CgalVisibility {
 public:
  explicit CgalVisibility(const std::vector<Segment>& segments);
  ~CgalVisibility();

  /// What is seen from a point, counterclockwise and regularised; none if it lies on a segment.
  std::optional<std::vector<TPoint2D>> polygon(const TPoint2D& from) const;

  /// The same left in CGAL's form, to be timed: the number of its vertices, 0 for none. The face
  /// that holds the point is found by its own means, as part of the task.
  std::size_t see(const TPoint2D& from) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrpt_polyloc::test
