#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/ranking/default_calibration.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {

Calibration::Calibration()
    : match_intercept(default_calibration::kMatchIntercept),
      match_weights(default_calibration::kMatchWeights),
      least_match_probability(default_calibration::kLeastMatchProbability),
      lost_thresholds(default_calibration::kLostThresholds),
      weight_decay(default_calibration::kWeightDecay),
      unique_probability(default_calibration::kUniqueProbability),
      position_factor(default_calibration::kPositionFactor),
      heading_factor(default_calibration::kHeadingFactor) {}

void Calibration::check() const {
  constexpr double kGreatest = std::numeric_limits<double>::max();  // any finite number
  requireInRange("match_intercept", match_intercept, -kGreatest, kGreatest);
  for (std::size_t i = 0; i < match_weights.size(); ++i) {
    const std::string name = std::string("match_weights.") + MatchFeatures::kNames[i];
    requireInRange(name.c_str(), match_weights[i], -kGreatest, kGreatest);
  }
  requireInRange("least_match_probability", least_match_probability, 0.0, 1.0);
  for (std::size_t i = 0; i < lost_thresholds.size(); ++i) {
    requireInRange("lost_thresholds", lost_thresholds[i], i == 0 ? 0.0 : lost_thresholds[i - 1],
                   1.0);
  }
  requirePositive("weight_decay", weight_decay);
  requirePositive("unique_probability", unique_probability);
  requirePositive("position_factor", position_factor);
  requirePositive("heading_factor", heading_factor);
}

double Calibration::thresholdFor(double lost) const {
  requireInRange("lost", lost, 0.0, 1.0);
  const auto* const above = std::upper_bound(kLostShares.begin(), kLostShares.end(), lost);
  return lost_thresholds[static_cast<std::size_t>(above - kLostShares.begin()) - 1];
}

double Calibration::matchProbability(const MatchFeatures& features) const {
  const std::array<double, MatchFeatures::kCount> values = features.values();
  double score = match_intercept;
  for (std::size_t i = 0; i < values.size(); ++i) score += match_weights[i] * values[i];
  return 1.0 / (1.0 + std::exp(-score));
}

}  // namespace mrpt_polyloc
