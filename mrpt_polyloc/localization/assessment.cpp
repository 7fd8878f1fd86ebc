#include <mrpt_polyloc/localization/BeamBlocks.h>
#include <mrpt_polyloc/localization/MatchFeatures.h>
#include <mrpt_polyloc/localization/assessment.h>

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

void assess(const std::vector<RankedPose>& poses, const RangeScan& scan, const ScanCost& cost,
            const HypothesisParams& params, std::size_t max_hypotheses,
            LocalizationResult& result) {
  result.status = LocalizationStatus::no_match;
  result.match_probability = 0.0;
  result.features.reset();
  result.hypotheses.clear();
  if (poses.empty()) return;

  std::vector<std::size_t> order;
  std::vector<Hypothesis> hypotheses = toHypotheses(poses, scan, cost, params, &order);
  const BeamBlocks blocks(cost.beams());
  result.features = matchFeatures(poses, poses[order.front()], cost, blocks);
  result.match_probability = params.calibration.matchProbability(*result.features);
  if (result.match_probability < params.calibration.least_match_probability) return;

  const double first_is_right = result.match_probability * hypotheses.front().weight;
  result.status = first_is_right >= params.calibration.unique_probability
                      ? LocalizationStatus::unique
                      : LocalizationStatus::ambiguous;
  result.hypotheses = cutShort(std::move(hypotheses), max_hypotheses);
}

}  // namespace mrpt_polyloc
