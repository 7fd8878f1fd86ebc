#pragma once

#include <mrpt_polyloc/localization/Calibration.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/RankedPose.h>
#include <mrpt_polyloc/localization/ScanCost.h>

#include <vector>

namespace mrpt_polyloc {

struct HypothesisParams {
  double merge_distance = 0.2;               ///< poses nearer than this are one hypothesis [m] ...
  double merge_angle = 0.06981317007977318;  ///< ... if their headings are, too [rad], 4 degrees
  /// A difference of the mean evidence counts in units of its standard error, or of this if that is
  /// less [m]: the map itself is not better.
  double indifference = 0.004;
  Calibration calibration;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Sorted by cost, of poses that are nearly one only the best.
std::vector<RankedPose> mergeNearPoses(std::vector<RankedPose> poses,
                                       const HypothesisParams& params = {});

/// The poses as hypotheses for the robot, ranked by the evidence (beamEvidence()), with covariance
/// and weight.
///
/// A weight is the probability that the hypothesis is the right one, given that one of them is: the
/// softmax of -weight_decay * Hypothesis::behind.
/// \param poses all that may be rivals \param order if not null, receives the index in `poses` of
/// each hypothesis
std::vector<Hypothesis> toHypotheses(const std::vector<RankedPose>& poses, const RangeScan& scan,
                                     const ScanCost& cost, const HypothesisParams& params = {},
                                     std::vector<std::size_t>* order = nullptr);

}  // namespace mrpt_polyloc
