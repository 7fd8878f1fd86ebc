#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/localization/scan/beam_evidence.h>

#include <algorithm>

namespace mrpt_polyloc {

void BeamEvidenceParams::check() const {
  cost.check();
  requireInRange("hidden_cost", hidden_cost, 0.0, 10.0);
  requireInRange("most_hidden", most_hidden, 0.0, 1e3);
  requireInRange("off_wall_cost", off_wall_cost, 0.0, 10.0);
  requirePositive("wall_sigma", wall_sigma);
  requirePositive("thinning", thinning);
  requireInRange("tolerance", tolerance, 0.0, 1e3);
}

std::vector<float> beamEvidence(const std::vector<Beam>& beams, const PredictedRanges& predicted,
                                const BeamEvidenceParams& params) {
  RobustCostParams shifted = params.cost;
  shifted.tau_short += params.tolerance;
  shifted.tau_long += params.tolerance;
  shifted.tau_open += params.tolerance;
  const RobustCost cost(shifted);
  const auto tolerance = static_cast<float>(params.tolerance);
  const auto hidden_cost = static_cast<float>(params.hidden_cost);
  const auto most_hidden = static_cast<float>(params.most_hidden);
  const auto hidden_from = static_cast<float>(params.cost.tau_short);
  std::vector<float> evidence(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const float wall = predicted.wall[i], open = predicted.open[i];
    evidence[i] = cost(beams[i], wall, open);
    if (beams[i].kind != BeamKind::hit) continue;
    evidence[i] = std::max(0.0F, evidence[i] - tolerance);
    const float hidden = std::min(wall, open) - static_cast<float>(beams[i].range) - hidden_from;
    evidence[i] += hidden_cost * std::clamp(hidden, 0.0F, most_hidden);
  }
  return evidence;
}

}  // namespace mrpt_polyloc
