#pragma once

#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/scan/ScoredPose.h>

#include <vector>

namespace mrpt_polyloc {

/// Sorted by cost, of poses that are nearly one only the best.
std::vector<ScoredPose> mergeNearPoses(std::vector<ScoredPose> poses,
                                       const HypothesisParams& params = {});

/// The poses as hypotheses for the robot, ranked by the evidence (BeamEvidence), with covariance
/// and weight.
///
/// A weight is the probability that the hypothesis is the right one, given that one of them is: the
/// softmax of -weight_decay * Hypothesis::z_score.
/// \param poses all that may be rivals \param order if not null, receives the index in `poses` of
/// each hypothesis
std::vector<Hypothesis> toHypotheses(const std::vector<ScoredPose>& poses, const RangeScan& scan,
                                     const ScanCost& cost, const HypothesisParams& params = {},
                                     std::vector<std::size_t>* order = nullptr);

}  // namespace mrpt_polyloc
