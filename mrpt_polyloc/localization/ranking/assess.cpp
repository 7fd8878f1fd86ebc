#include <mrpt_polyloc/localization/ranking/assess.h>
#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

namespace mrpt_polyloc {
namespace {

/// The first so many, weights summing to 1 again.
std::vector<Hypothesis> cutShort(std::vector<Hypothesis> hypotheses, std::size_t count) {
  if (hypotheses.size() <= count) return hypotheses;
  hypotheses.resize(count);
  double sum = 0.0;
  for (const Hypothesis& hypothesis : hypotheses) sum += hypothesis.weight;
  for (Hypothesis& hypothesis : hypotheses) hypothesis.weight /= sum;
  return hypotheses;
}

}  // namespace

Assessment assess(const std::vector<ScoredPose>& poses, const RangeScan& scan, const ScanCost& cost,
                  const HypothesisParams& params, std::size_t max_hypotheses) {
  Assessment result;
  if (poses.empty()) return result;

  std::vector<std::size_t> order;
  std::vector<Hypothesis> hypotheses = toHypotheses(poses, scan, cost, params, &order);
  const BeamSectors sectors(cost.beams());
  result.features = matchFeatures(poses, poses[order.front()], cost, sectors);
  result.match_probability = params.calibration.matchProbability(*result.features);
  if (result.match_probability < params.calibration.least_match_probability) return result;

  const double first_is_right = result.match_probability * hypotheses.front().weight;
  result.status = first_is_right >= params.calibration.unique_probability
                      ? LocalizationStatus::unique
                      : LocalizationStatus::ambiguous;
  result.hypotheses = cutShort(std::move(hypotheses), max_hypotheses);
  return result;
}

}  // namespace mrpt_polyloc
