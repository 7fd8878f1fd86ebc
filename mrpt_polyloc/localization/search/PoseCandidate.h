#pragma once

#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// A pose that a search proposes.
struct PoseCandidate {
  mrpt::math::TPose2D pose_map_beams;  ///< of the beam frame (see RangeScan) in the map [m, rad]
  double cost = 0.0;                   ///< search cost, near the pose [m]
};

}  // namespace mrpt_polyloc
