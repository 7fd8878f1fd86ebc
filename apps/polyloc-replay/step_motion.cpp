#include "step_motion.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>

namespace mrpt_polyloc::replay {

Motion motionOf(const ReplayStep& step) {
  if (!step.action) return {};
  const auto movement = step.action->getBestMovementEstimation();
  return measuredMotion(movement->poseChange->getMeanVal().asTPose());
}

}  // namespace mrpt_polyloc::replay
