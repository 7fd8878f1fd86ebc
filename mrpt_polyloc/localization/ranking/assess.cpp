#include <mrpt_polyloc/localization/ranking/assess.h>
#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/localization/ranking/valleys.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// Gives hypotheses, the heaviest first, the z-scores of which their weights are the softmax.
void followWeights(std::vector<Hypothesis>& hypotheses, double decay) {
  const double first = hypotheses.front().weight;
  for (Hypothesis& hypothesis : hypotheses) {
    if (hypothesis.weight <= 0.0) continue;  // hopeless: what it was is as good
    hypothesis.z_score = std::log(first / hypothesis.weight) / decay;
  }
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
  if (params.unite_valleys) {
    // The status stands: a pose that is not known along a corridor is not unique.
    const std::vector<std::size_t> of_poses = valleysOf(poses, cost, sectors);
    std::vector<std::size_t> valleys;
    for (const std::size_t i : order) valleys.push_back(of_poses[i]);
    const std::size_t single = hypotheses.size();
    hypotheses = uniteValleys(hypotheses, valleys);
    if (hypotheses.size() < single) followWeights(hypotheses, params.calibration.weight_decay);
  }
  if (hypotheses.size() > max_hypotheses) hypotheses.resize(max_hypotheses);
  for (const Hypothesis& hypothesis : hypotheses) result.listed += hypothesis.weight;
  result.hypotheses = std::move(hypotheses);
  return result;
}

}  // namespace mrpt_polyloc
