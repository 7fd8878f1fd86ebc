#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// RobustCost of a whole scan at given poses, over all beams that say something.
class ScanCost {
 public:
  /// Ranges beyond count as this in the polar metric [m].
  static constexpr double kReach = 127.5;

  /// Keeps a reference to the predictor.
  ScanCost(const RangePredictor& predictor, const RangeScan& scan, const RobustCostParams& params);

  /// Beams that take part: hits and no-returns, in the scan's order.
  std::size_t beamCount() const { return beams_.size(); }

  const std::vector<Beam>& beams() const { return beams_; }
  const RangePredictor& predictor() const { return *predictor_; }

  /// What the map predicts for these beams.
  void predict(const mrpt::math::TPose2D& pose_map_beams, PredictedRanges& out) const {
    predictor_->predict(pose_map_beams, pattern_, out);
  }

  /// The mean over the beams [m]; 0 if there are none.
  double mean(const mrpt::math::TPose2D& pose_map_beams) const;

  /// The paper's polar coordinate metric, sampled at the hits: the root of the mean squared
  /// difference between their ranges and those to the first walls [m]; 0 if there are none. Ranges
  /// beyond kReach count as that, also where no wall is met.
  double polarDistance(const mrpt::math::TPose2D& pose_map_beams) const;

  /// The cost of each beam [m].
  std::vector<float> perBeam(const mrpt::math::TPose2D& pose_map_beams) const;

 private:
  const RangePredictor* predictor_;
  RobustCost cost_;
  std::vector<Beam> beams_;
  BeamPattern pattern_;
};

}  // namespace mrpt_polyloc
