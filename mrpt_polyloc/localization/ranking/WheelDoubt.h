#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/CMatrixFixed.h>

#include <array>
#include <vector>

namespace mrpt_polyloc {

/// By how much a movement that scans tell differs from what the wheels said of it.
struct POLYLOC_EXPORT MovementError {
  std::array<double, 3> off{};         ///< (x, y, phi) in the earlier pose's axes [m, rad]
  mrpt::math::CMatrixDouble33 wheels;  ///< covariance that the wheels say of themselves
  mrpt::math::CMatrixDouble33 scans;   ///< covariance of the movement by the scans alone
};

/// How much worse wheels are than they say, by what scans make of a drive.
struct POLYLOC_EXPORT WheelDoubt {
  double scale = 1.0;  ///< their standard deviations times this are likeliest; at least 1
  /// What the movements speak against a drive at that scale, as -ln of their likelihood, up to a
  /// constant that all drives of one set have in common.
  double against = 0.0;
};

/// The scale at which the movements are likeliest: each is off by a Gaussian with the covariance
/// scale^2 * wheels + scans, so that what scans do not tell (along a corridor) speaks for no scale.
/// What is known before them counts as one movement more that was just as the wheels said: two or
/// three movements that are off by chance are no reason yet. Cost: 3 by 3 matrices, some fifty
/// scales.
POLYLOC_EXPORT WheelDoubt doubtWheels(const std::vector<MovementError>& movements);

}  // namespace mrpt_polyloc
