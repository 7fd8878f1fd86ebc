#pragma once

#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/scan/PoseDescent.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <optional>

namespace mrpt_polyloc {

/// The search cost of single poses, over the beams that the search bounds: how good a pose is that
/// bounds only hint at.
class PoseScorer {
 public:
  /// Keeps references to predictor and allowed poses. \param sensor the beams' origin in the robot
  /// frame
  PoseScorer(const RangePredictor& predictor, const BandQuery& query,
             const mrpt::math::TPoint2D& sensor, const AllowedPoses& allowed,
             const RobustCostParams& cost, const PoseRefinerParams& refinement);
  PoseScorer(const PoseScorer&) = delete;
  PoseScorer& operator=(const PoseScorer&) = delete;

  /// Of the pose itself [m].
  double costAt(const mrpt::math::TPose2D& pose_map_beams) const;
  /// The same; infinity if the pose is not allowed.
  double costIfAllowed(const mrpt::math::TPose2D& pose_map_beams) const;
  /// The pose that a descent from there ends near, within a centimetre or so, with its cost [m];
  /// nothing if it meets none that is allowed.
  std::optional<ScoredPose> optimumBelow(const mrpt::math::TPose2D& pose_map_beams) const;
  /// Its cost [m]; infinity if there is none.
  double costBelow(const mrpt::math::TPose2D& pose_map_beams) const;
  /// The same pose; nothing if it meets none that is allowed, or if some steps with
  /// some beams lead to no cost below `promising` [m]. Takes a fraction of the time.
  std::optional<ScoredPose> nearOptimum(const mrpt::math::TPose2D& pose_map_beams,
                                        double promising) const;

 private:
  SearchMetric metric_;
  ScanCost cost_;
  PoseRefiner near_refiner_, rough_refiner_;
  PoseDescent near_descent_;
  const AllowedPoses* allowed_;
};

}  // namespace mrpt_polyloc
