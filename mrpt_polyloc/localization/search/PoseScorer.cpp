#include <mrpt_polyloc/localization/search/PoseScorer.h>

#include <algorithm>

namespace mrpt_polyloc {

PoseScorer::PoseScorer(const RangePredictor& predictor, const BandQuery& query,
                       const mrpt::math::TPoint2D& sensor, const RobustCostParams& cost,
                       const PoseRefinerParams& refinement)
    : metric_(query.metric),
      cost_(predictor, RangeScan(query.beams, sensor), cost),
      refiner_(predictor, RangeScan(query.beams, sensor), refinement) {}

double PoseScorer::costAt(const mrpt::math::TPose2D& pose) const {
  return metric_ == SearchMetric::polar ? cost_.polarDistance(pose) : cost_.mean(pose);
}

double PoseScorer::refinedCost(const mrpt::math::TPose2D& pose) const {
  return std::min(costAt(pose), costAt(refiner_.refine(pose).pose_map_beams));
}

}  // namespace mrpt_polyloc
