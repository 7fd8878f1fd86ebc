#include <mrpt_polyloc/localization/search/PoseScorer.h>

#include <algorithm>
#include <limits>

namespace mrpt_polyloc {
namespace {

PoseRefinerParams nearEnough(PoseRefinerParams params) {
  params.step_tolerance = std::max(params.step_tolerance, 1e-2);  // [m]
  params.turn_tolerance = std::max(params.turn_tolerance, 3e-3);  // [rad]
  return params;
}

/// The way down, but for the last centimetres: from the middle of a leaf it takes two or three
/// steps.
PoseRefinerParams rough(PoseRefinerParams params) {
  constexpr int kSteps = 3;
  params.max_iterations = std::min(params.max_iterations, kSteps);
  return nearEnough(params);
}
constexpr std::size_t kRoughBeams = 60;

}  // namespace

PoseScorer::PoseScorer(const RangePredictor& predictor, const BandQuery& query,
                       const mrpt::math::TPoint2D& sensor, const AllowedPoses& allowed,
                       const RobustCostParams& cost, const PoseRefinerParams& refinement)
    : metric_(query.metric),
      cost_(predictor, RangeScan(query.beams, sensor), cost),
      near_refiner_(predictor, RangeScan(query.beams, sensor), nearEnough(refinement)),
      rough_refiner_(predictor, RangeScan(query.beams, sensor), rough(refinement), kRoughBeams),
      near_descent_(near_refiner_, allowed,
                    [this](const mrpt::math::TPose2D& pose) { return costAt(pose); }),
      allowed_(&allowed) {}

double PoseScorer::costAt(const mrpt::math::TPose2D& pose) const {
  return metric_ == SearchMetric::polar ? cost_.polarDistance(pose) : cost_.mean(pose);
}

double PoseScorer::costIfAllowed(const mrpt::math::TPose2D& pose) const {
  return allowed_->contains(pose) ? costAt(pose) : std::numeric_limits<double>::infinity();
}

std::optional<ScoredPose> PoseScorer::optimumBelow(const mrpt::math::TPose2D& pose) const {
  return near_descent_.descend(pose);
}

double PoseScorer::costBelow(const mrpt::math::TPose2D& pose) const {
  const std::optional<ScoredPose> found = optimumBelow(pose);
  return found ? found->cost : std::numeric_limits<double>::infinity();
}

std::optional<ScoredPose> PoseScorer::nearOptimum(const mrpt::math::TPose2D& pose,
                                                  double promising) const {
  const mrpt::math::TPose2D below = rough_refiner_.refinedPose(pose);
  // What is not allowed is left to the descent, which keeps to it.
  if (!allowed_->contains(below)) return near_descent_.descend(pose);
  if (costAt(below) > promising) return std::nullopt;
  return near_descent_.descend(below);
}

}  // namespace mrpt_polyloc
