#pragma once

namespace mrpt_polyloc::apps {

/// The command line and the CSV speak degrees, the library radians.
constexpr double kDegree = 0.017453292519943295769;  ///< [rad]
constexpr double toRadians(double degrees) {
  return degrees * kDegree;
}
constexpr double toDegrees(double radians) {
  return radians / kDegree;
}

}  // namespace mrpt_polyloc::apps
