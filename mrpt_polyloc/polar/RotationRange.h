#pragma once

#include <mrpt_polyloc/geometry/angles.h>

namespace mrpt_polyloc {

/// Which rotations to search: those within `tolerance` of `center`, all of them by default. What a
/// compass with a known error leaves over.
struct RotationRange {
  double center = 0.0;     ///< [rad], any finite angle
  double tolerance = kPi;  ///< [rad], in [0, pi]; pi: all rotations

  bool isFullCircle() const { return tolerance >= kPi; }

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
