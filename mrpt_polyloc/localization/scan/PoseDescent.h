#pragma once

#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/ScoredPose.h>

#include <mrpt/math/TPose2D.h>

#include <functional>
#include <optional>

namespace mrpt_polyloc {

/// Refinement that keeps to what is allowed and never ends at a higher cost.
class PoseDescent {
 public:
  using Cost = std::function<double(const mrpt::math::TPose2D& pose_map_beams)>;

  /// Keeps references to refiner and allowed poses. \param cost by which poses are compared [m]
  PoseDescent(const PoseRefiner& refiner, const AllowedPoses& allowed, Cost cost);

  /// The cheaper of the start and of where refinement leads from it: if that is not allowed, of the
  /// nearest pose that the prior allows, or of the last one on the way there in free space. The
  /// start itself is first moved to where the prior allows it. Nothing if nothing is allowed.
  std::optional<ScoredPose> descend(const mrpt::math::TPose2D& start) const;

 private:
  const PoseRefiner* refiner_;
  const AllowedPoses* allowed_;
  Cost cost_;
};

}  // namespace mrpt_polyloc
