#include <mrpt_polyloc/localization/scan/PoseDescent.h>

#include <utility>

namespace mrpt_polyloc {

PoseDescent::PoseDescent(const PoseRefiner& refiner, const AllowedPoses& allowed, Cost cost)
    : refiner_(&refiner), allowed_(&allowed), cost_(std::move(cost)) {}

std::optional<ScoredPose> PoseDescent::descend(const mrpt::math::TPose2D& start) const {
  const mrpt::math::TPose2D begin = allowed_->nearest(start);
  const bool is_begin_allowed = allowed_->contains(begin);
  RefinedPose end = refiner_->refine(begin);
  if (!allowed_->contains(end.pose_map_beams)) {
    // Back to where the prior allows it; if that is no free space, as far as there is some.
    const mrpt::math::TPose2D back = allowed_->nearest(end.pose_map_beams);
    if (allowed_->contains(back)) {
      end = refiner_->at(back);
    } else if (is_begin_allowed) {
      end = refiner_->at(allowed_->lastOnTheWay(begin, back));
    } else {
      return std::nullopt;
    }
  }
  const ScoredPose refined{end, cost_(end.pose_map_beams)};
  if (!is_begin_allowed) return refined;
  const double cost_of_begin = cost_(begin);
  if (refined.cost <= cost_of_begin) return refined;
  return ScoredPose{refiner_->at(begin), cost_of_begin};
}

}  // namespace mrpt_polyloc
