#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc {

/// A straight wall [m].
struct WallSegment {
  TPoint2D a, b;
};

/// Range [m] from a point along a unit vector to a wall, its end points included; infinity if it is
/// not met.
double rangeTo(const WallSegment& wall, const TPoint2D& origin, const TPoint2D& ray);

/// All walls of a map as a bare list of segments, searched one by one in double.
///
/// Slow and simple on purpose: simulated scans and tests need ranges that share nothing with the
/// search's own predictor. Open edges are left out (a beam passes them), walls beyond are in.
class WallSegments {
 public:
  explicit WallSegments(const PolygonMap& map);

  /// Range [m] from a point along a direction (angle in the map [rad]) to the first wall; infinity
  /// if there is none. A wall's end points belong to it. O(number of walls).
  double range(const TPoint2D& origin, double direction) const;

  /// Distance [m] to the nearest wall; infinity if there is none. O(number of walls).
  double distance(const TPoint2D& point) const;

 private:
  std::vector<WallSegment> segments_;
};

}  // namespace mrpt_polyloc
