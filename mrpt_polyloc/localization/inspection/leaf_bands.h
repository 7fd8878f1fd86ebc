#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/MapIndex.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// What the certified search knows of one of its leaves: bounds of the ranges that are seen from
/// anywhere in it. To be looked at; the search itself takes them as they are stored.
struct POLYLOC_EXPORT LeafBands {
  std::size_t leaf = 0;
  std::vector<mrpt::math::TPoint2D> polygon;  ///< convex, counterclockwise [m]
  /// Of the directions from b * width to (b + 2) * width in the map, for each b.
  struct Bin {
    double near = 0.0;  ///< nothing is met nearer [m]
    double wall = 0.0;  ///< the first wall is not farther [m]; infinity where that is not known
    double gap_low = 0.0, gap_high = 0.0;  ///< no wall is met between [m]; both 0: no such gap
  };
  std::vector<Bin> bins;
  double width = 0.0;  ///< of a bin [rad]
};

/// The leaf that holds a point, nothing outside free space. Prepares the search tree if the index
/// is a deferred one. O(leaves), some ms on large maps.
POLYLOC_EXPORT std::optional<LeafBands> leafBandsAt(const MapIndex& index,
                                                    const mrpt::math::TPoint2D& point);

}  // namespace mrpt_polyloc
