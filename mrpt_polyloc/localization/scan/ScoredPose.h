#pragma once

#include <mrpt_polyloc/localization/scan/PoseRefiner.h>

namespace mrpt_polyloc {

/// A refined pose with its cost over all beams.
struct ScoredPose {
  RefinedPose refined;
  double cost = 0.0;  ///< mean [m]
};

}  // namespace mrpt_polyloc
