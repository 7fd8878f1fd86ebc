#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc {

/// All walls of a map as a bare list of segments, searched one by one in double.
///
/// Slow and simple on purpose: simulated scans and tests need ranges that share nothing with the
/// search's own predictor. Open edges are left out (a beam passes them), walls beyond are in.
class POLYLOC_EXPORT WallSegments {
 public:
  explicit WallSegments(const PolygonMap& map);

  /// Range [m] from a point along a direction (angle in the map [rad]) to the first wall; infinity
  /// if there is none. A wall's end points belong to it. O(number of walls).
  double range(const TPoint2D& origin, double direction) const;

  /// Distance [m] to the nearest wall; infinity if there is none. O(number of walls).
  double distance(const TPoint2D& point) const;

 private:
  struct Segment {
    TPoint2D a, b;
  };
  std::vector<Segment> segments_;
};

}  // namespace mrpt_polyloc
