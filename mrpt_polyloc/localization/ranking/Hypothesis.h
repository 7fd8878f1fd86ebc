#pragma once

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// One pose that explains the scan.
struct Hypothesis {
  mrpt::math::TPose2D pose_map_robot;      ///< of the ROBOT, not its sensor [m, rad]
  mrpt::math::CMatrixDouble33 covariance;  ///< of (x, y, phi) of the robot [m, rad]
  /// Probability that this is the pose, if the scan was taken in this map: a share of the whole
  /// posterior, also of poses that are not returned.
  double weight = 0.0;
  double cost = 0.0;  ///< mean robust cost per beam [m]
  /// By how many standard errors it explains the scan worse than the first does, sectors of beams
  /// taken as the independent observations; 0 for the first.
  double z_score = 0.0;
};

}  // namespace mrpt_polyloc
