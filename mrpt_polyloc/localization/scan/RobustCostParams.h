#pragma once

#include <mrpt_polyloc/base/export.h>

namespace mrpt_polyloc {

/// The truncations of RobustCost, all in metres.
struct POLYLOC_EXPORT RobustCostParams {
  /// Cap where a beam ends before the map's wall: an obstacle that is not in the map.
  double tau_short = 0.4;
  /// Cap where a beam passes the map's wall: contradicts the map, so above tau_short.
  double tau_long = 0.6;
  /// Cap where a beam went on past an open edge, into what the map does not know, and ended there
  /// before the first wall beyond. (Beyond that wall tau_long holds: the wall is known.)
  double tau_open = 0.25;
  /// Cost of a beam without return where a near wall should have returned it; glass and black paint
  /// do that, so the smallest of all.
  double tau_none = 0.15;
  /// A wall is near if it stands within this share of the range up to which nothing was seen.
  double none_share = 0.8;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
