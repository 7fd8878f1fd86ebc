#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>
#include <mrpt_polyloc/localization/ranking/WheelDoubt.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A way through the map that a scan set may have been seen from, at its local optimum.
struct POLYLOC_EXPORT RefinedWay {
  std::vector<mrpt::math::TPose2D> poses;  ///< of the robot in the map, at each moment
  mrpt::math::CMatrixDouble33 covariance;  ///< of the last of them
  /// By how much the movements between them differ from what the wheels said: the sum of squares in
  /// units of their covariances, three degrees of freedom a movement.
  double tension = 0.0;
};

/// What is known of the pose at the first moment before its scans, as a Gaussian.
struct POLYLOC_EXPORT GaussianPose {
  mrpt::math::TPose2D pose_map_robot{0, 0, 0};
  mrpt::math::CMatrixDouble33 covariance;
  /// How much the scans count beside it, in (0, 1]: less than one if they are not independent of
  /// those that it comes from.
  double share = 1.0;
};

/// PoseRefiner for a scan set: Gauss-Newton on the beams of all scans and the movements between
/// the moments at once, each pose free within what the wheels' covariance allows.
///
/// A sector of ten degrees counts as one observation (see BeamSectors), a moment as MomentWeights
/// says. Cost: that of PoseRefiner for each scan, and a system of three unknowns a moment.
class POLYLOC_EXPORT SetRefiner {
 public:
  /// Keeps references to predictor and set. At most `max_beams` hits a scan are used; 0: all.
  SetRefiner(const RangePredictor& predictor, const ScanSet& set, const MomentWeights& weights,
             const PoseRefinerParams& params = {}, const Calibration& calibration = Calibration(),
             std::size_t max_beams = 0);

  /// The poses at all moments, if the wheels are right and the robot is here now.
  std::vector<mrpt::math::TPose2D> wayTo(const mrpt::math::TPose2D& pose_map_robot) const;

  /// \param wheel_scale the wheels are so many times worse than they say: their standard deviations
  /// are multiplied by this
  /// The robot's pose at one moment, by its scans alone. \param k index of the moment
  mrpt::math::TPose2D refineAlone(std::size_t k, const mrpt::math::TPose2D& start) const;

  RefinedWay refine(const std::vector<mrpt::math::TPose2D>& start, double wheel_scale = 1.0) const;
  /// With what was known of the first moment's pose.
  RefinedWay refine(const std::vector<mrpt::math::TPose2D>& start, const GaussianPose& known) const;
  /// A way as it is, with what scans and wheels say there.
  RefinedWay at(const std::vector<mrpt::math::TPose2D>& way, double wheel_scale = 1.0) const;

  /// What the movements of a way differ by from what the wheels said, one for each moment but the
  /// first.
  std::vector<MovementError> movementErrors(const std::vector<mrpt::math::TPose2D>& way) const;

 private:
  struct System;
  struct MomentStep;
  MomentStep stepAt(std::size_t k, const mrpt::math::TPose2D& pose_map_robot) const;
  System linearize(const std::vector<mrpt::math::TPose2D>& way, const GaussianPose* known,
                   double wheel_scale) const;
  RefinedWay refine(const std::vector<mrpt::math::TPose2D>& start, const GaussianPose* known,
                    double wheel_scale, int max_iterations) const;

  const ScanSet* set_;
  PoseRefinerParams params_;
  std::vector<std::vector<PoseRefiner>> refiners_;  ///< of each moment's scans
  std::vector<double> sectors_;                     ///< of each moment
  std::vector<double> shares_;                      ///< of each moment, how much it counts
  double variance_;      ///< of a sector's hits, with what all scans err by together [m^2]
  double own_variance_;  ///< the same without
};

}  // namespace mrpt_polyloc
