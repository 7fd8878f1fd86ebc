#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// All poses from which a view of limited range is seen. Where it holds a corner, these are points;
/// where it holds but one wall or two parallel ones, the robot may move along them; where it holds
/// nothing, it may stand anywhere far enough from every border.
struct POLYLOC_EXPORT LimitedAnswers {
  struct Segment {
    mrpt::math::TPoint2D from, to;  ///< of the robot in the map, both ends with it [m]
    double heading;                 ///< at every point of it [rad]
  };
  /// All points of free space that are no nearer to its border than the range, at any heading.
  struct Region {
    double clearance;             ///< the range [m]
    mrpt::math::TPoint2D inside;  ///< one point of it, as far from the border as found
  };
  std::vector<mrpt::math::TPose2D> points;  ///< sorted by x, y and heading
  std::vector<Segment> segments;            ///< sorted by x and y of `from`, and heading
  std::optional<Region> region;

  bool empty() const { return points.empty() && segments.empty() && !region; }
};

}  // namespace mrpt_polyloc
