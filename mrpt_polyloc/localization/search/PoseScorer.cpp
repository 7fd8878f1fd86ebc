#include <mrpt_polyloc/localization/search/PoseScorer.h>

#include <limits>

namespace mrpt_polyloc {

PoseScorer::PoseScorer(const RangePredictor& predictor, const BandQuery& query,
                       const mrpt::math::TPoint2D& sensor, const AllowedPoses& allowed,
                       const RobustCostParams& cost, const PoseRefinerParams& refinement)
    : metric_(query.metric),
      cost_(predictor, RangeScan(query.beams, sensor), cost),
      refiner_(predictor, RangeScan(query.beams, sensor), refinement),
      descent_(refiner_, allowed,
               [this](const mrpt::math::TPose2D& pose) { return costAt(pose); }) {}

double PoseScorer::costAt(const mrpt::math::TPose2D& pose) const {
  return metric_ == SearchMetric::polar ? cost_.polarDistance(pose) : cost_.mean(pose);
}

double PoseScorer::costBelow(const mrpt::math::TPose2D& pose) const {
  const std::optional<ScoredPose> found = descent_.descend(pose);
  return found ? found->cost : std::numeric_limits<double>::infinity();
}

}  // namespace mrpt_polyloc
