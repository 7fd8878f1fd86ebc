#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// What the certified search has proven: no pose that the prior allows, its sensor in free space,
/// has a search cost of at most `cost` but those near the hypotheses and in regions that bounds do
/// not exclude (see GlobalLocalizerParams::keep_regions).
struct Certificate {
  double cost = 0.0;        ///< search cost [m]: a mean over the beams searched with
  bool is_complete = true;  ///< false: a budget ended the search before the margin was reached
  std::size_t regions = 0;  ///< not excluded, each a leaf and a few degrees of heading
  /// Of a scan set: the moment of the scan that was searched, and its number among those of the
  /// moment. The certificate speaks of poses of that scan alone.
  std::size_t moment = 0, scan = 0;
};

/// Poses of the beam frame (see RangeScan) in the map that could not be excluded.
struct PoseRegion {
  std::vector<mrpt::math::TPoint2D> polygon;  ///< convex polygon of the sensor's positions [m]
  double first_heading, last_heading;         ///< counterclockwise from the first to the last [rad]
  double bound;                               ///< no pose of it has a lower search cost [m]
};

}  // namespace mrpt_polyloc
