#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {

LocalizationResult resultOf(Assessment assessment) {
  LocalizationResult result;
  result.status = assessment.status;
  result.match_probability = assessment.match_probability;
  result.features = assessment.features;
  result.hypotheses = std::move(assessment.hypotheses);
  result.listed = assessment.listed;
  return result;
}

LocalizationResult resultOf(const ExactAnswers& answers, double tolerance,
                            std::size_t max_hypotheses) {
  const auto& poses = answers.poses;
  LocalizationResult result;
  result.statistics.positions = answers.positions;
  result.statistics.evaluated = answers.evaluated;
  result.match_probability = poses.empty() ? 0.0 : 1.0;  // without noise nothing is left to chance
  result.status = poses.empty()       ? LocalizationStatus::no_match
                  : poses.size() == 1 ? LocalizationStatus::unique
                                      : LocalizationStatus::ambiguous;
  const std::size_t count = std::min(poses.size(), max_hypotheses);
  for (std::size_t i = 0; i < count; ++i) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = poses[i];
    hypothesis.covariance.setZero();
    for (int k = 0; k < 3; ++k) hypothesis.covariance(k, k) = tolerance * tolerance;
    hypothesis.weight = 1.0 / static_cast<double>(poses.size());
    result.listed += hypothesis.weight;
    result.hypotheses.push_back(hypothesis);
  }
  return result;
}

}  // namespace mrpt_polyloc
