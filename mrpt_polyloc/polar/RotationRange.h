#pragma once

#include <mrpt_polyloc/base/angles.h>

#include <cstddef>

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

/// Rotations first, first + 1, ... (mod k), `count` of them, by multiples of 2 pi / k.
struct IndexRange {
  std::size_t first, count;
};

/// The multiples of 2 pi / k in a range; the nearest one to its centre if there is none.
/// \throws InvalidParamsError if the range is bad.
IndexRange indicesIn(const RotationRange& range, std::size_t k);

}  // namespace mrpt_polyloc
