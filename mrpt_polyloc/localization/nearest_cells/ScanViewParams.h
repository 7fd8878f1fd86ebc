#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT ScanViewParams {
  std::size_t samples = 180;  ///< k, see CirclePlan
  double range = 20.0;        ///< what is seen beyond is cut off [m]
  /// Directions without a hit are bridged where a gap is narrower than this: from hit to hit, as
  /// noise and glass leave them [rad], 10 degrees.
  double bridged_gap = 0.17453292519943295;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
