#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/travel/ExpectedReadings.h>

#include <vector>

namespace mrpt_polyloc {

/// How well one scan at a place would tell two hypotheses apart: by the evidence and the fitted
/// weights with which scans are judged (beamEvidence(), Calibration), applied to what the map
/// predicts instead of what was read.
///
/// Only what no reading can explain under both counts: the gap between two bands.
class POLYLOC_EXPORT PairEvidence {
 public:
  /// Standard error of a scan's mean cost that real rooms add, by people and moved furniture, to
  /// what the two predictions differ by [m]: with it two beams of 120 are needed to tell.
  static constexpr double kClutter = 0.01;

  PairEvidence(const LaserModel& laser, const HypothesisParams& params, double clutter = kClutter);

  /// 1 minus the factor by which the wrong one's weight falls against the right one's, whichever is
  /// right (the less of both), in [0, 1].
  double tells(const ExpectedReadings& a, const ExpectedReadings& b) const;

  /// By how many standard errors `judged` would fall behind if `truth` were read.
  double zScore(const ExpectedReadings& truth, const ExpectedReadings& judged) const;

 private:
  float cost(float low, float high, float judged_low, float judged_high) const;

  HypothesisParams params_;
  double least_error_;  ///< of a mean cost [m]
  float max_range_;
  BeamSectors sectors_;
  std::vector<float> nothing_;  ///< the cost of the truth, beam by beam
};

}  // namespace mrpt_polyloc
