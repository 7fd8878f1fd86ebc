#pragma once

#include <cmath>

namespace mrpt_polyloc {

constexpr double kPi = 3.14159265358979323846;
constexpr double kTwoPi = 2.0 * kPi;
constexpr double kDegree = kPi / 180.0;  ///< [rad]

/// Command lines, CSV and ini files speak degrees, the library radians.
constexpr double toRadians(double degrees) {
  return degrees * kDegree;
}
constexpr double toDegrees(double radians) {
  return radians / kDegree;
}

/// An angle [rad] brought into [0, 2 pi).
inline double wrapToTwoPi(double angle) {
  const double wrapped = angle - kTwoPi * std::floor(angle / kTwoPi);
  // Rounding takes tiny negative angles to 2 pi itself.
  return wrapped >= 0.0 && wrapped < kTwoPi ? wrapped : 0.0;
}

/// How far two headings are apart [rad], in [0, pi].
inline double angleBetween(double a, double b) {
  return std::abs(std::remainder(a - b, kTwoPi));
}

}  // namespace mrpt_polyloc
