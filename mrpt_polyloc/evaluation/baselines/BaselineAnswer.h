#pragma once

#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// A pose that a baseline proposes.
struct BaselineAnswer {
  mrpt::math::TPose2D pose_map_robot;
  double score = 0.0;  ///< its own, in [0, 1]; larger is better
};

}  // namespace mrpt_polyloc
