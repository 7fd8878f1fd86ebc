#pragma once

#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// The search cost of single poses, over the beams that the search bounds: how good a pose is that
/// bounds only hint at.
class PoseScorer {
 public:
  /// Keeps a reference to the predictor. \param sensor the beams' origin in the robot frame
  PoseScorer(const RangePredictor& predictor, const BandQuery& query,
             const mrpt::math::TPoint2D& sensor, const RobustCostParams& cost,
             const PoseRefinerParams& refinement);

  /// Of the pose itself [m].
  double costAt(const mrpt::math::TPose2D& pose_map_beams) const;
  /// The less of the pose's cost and of the one that refinement leads to [m].
  double refinedCost(const mrpt::math::TPose2D& pose_map_beams) const;

 private:
  SearchMetric metric_;
  ScanCost cost_;
  PoseRefiner refiner_;
};

}  // namespace mrpt_polyloc
