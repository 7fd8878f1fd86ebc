#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// What became of the regions that the search could not exclude: whether one of them may hold a
/// pose with a lower search cost than the best that is known. Each region counts once.
struct SettledRegions {
  /// No pose of them costs as little as the best that is known: proven, by the bound of the region
  /// or those of its two bins of heading.
  std::size_t bounded = 0;
  /// What costs least of the poses tried in them costs so much more than the best that no descent
  /// has been seen to lead from there to as little (CertifiedSearchParams::reach): measured.
  std::size_t distant = 0;
  /// From the cheapest pose tried in them, which costs less than those tried in all regions beside,
  /// a descent was made; its end is a candidate unless it costs more than the certificate's cost.
  std::size_t lowered = 0;
  /// Beside a cheaper region, and that perhaps beside a cheaper one, down to one that is lowered.
  std::size_t drained = 0;
  /// None of this: for want of time. An answer is never `unique` then. Where a budget ended the
  /// search, parts of the tree that were not opened count as one each.
  std::size_t undecided = 0;
};

/// What the certified search has proven: no pose that the prior allows, its sensor in free space,
/// has a search cost of at most `cost` but those near the hypotheses and in regions that bounds do
/// not exclude (see GlobalLocalizerParams::keep_regions).
struct Certificate {
  double cost = 0.0;        ///< search cost [m]: a mean over the beams searched with
  bool is_complete = true;  ///< false: a budget ended the search before the margin was reached
  std::size_t regions = 0;  ///< not excluded, each a leaf and a few degrees of heading
  SettledRegions settled;   ///< whether a cheaper pose may be in one of them
  double least = 0.0;       ///< search cost of the best pose found [m]
  /// Proven: no pose with its sensor in free space costs less [m]. A pose that is cheaper than the
  /// best found is so by `least` - `at_least` at most. 0 where a budget ended the search.
  double at_least = 0.0;
  /// Of a scan set: the moment of the scan that was searched, and its number among those of the
  /// moment. The certificate speaks of poses of that scan alone.
  std::size_t moment = 0, scan = 0;

  /// Nothing was left for want of time: what an answer that is `unique` needs.
  bool isDecided() const { return is_complete && settled.undecided == 0; }
};

/// Poses of the beam frame (see RangeScan) in the map that could not be excluded.
struct PoseRegion {
  std::vector<mrpt::math::TPoint2D> polygon;  ///< convex polygon of the sensor's positions [m]
  double first_heading, last_heading;         ///< counterclockwise from the first to the last [rad]
  double bound;                               ///< no pose of it has a lower search cost [m]
};

}  // namespace mrpt_polyloc
