#pragma once

#include <mrpt_polyloc/base/angles.h>

#include <mrpt/math/TPose2D.h>

#include <cmath>

namespace mrpt_polyloc {

/// A pose that a search proposes.
struct PoseCandidate {
  mrpt::math::TPose2D pose_map_beams;  ///< of the beam frame (see RangeScan) in the map [m, rad]
  double cost = 0.0;                   ///< search cost, near the pose [m]
};

/// Nearly the same optimum.
inline bool areNearlyOne(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  constexpr double kNear = 0.05, kNearHeading = 0.02;  // [m], [rad]
  return std::hypot(a.x - b.x, a.y - b.y) < kNear && angleBetween(a.phi, b.phi) < kNearHeading;
}

}  // namespace mrpt_polyloc
