#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/localization/scan/beam_evidence.h>

#include <algorithm>

namespace mrpt_polyloc {
namespace {

constexpr double kTauShort = 0.5;         // [m]
constexpr float kHiddenCost = 0.05F;      // per metre
constexpr float kMostHidden = 5.0F;       // [m]
constexpr float kHiddenFrom = kTauShort;  // [m] before the wall

RobustCost evidenceCost() {
  RobustCostParams params;
  params.tau_short = kTauShort;
  return RobustCost(params);
}

}  // namespace

std::vector<float> beamEvidence(const std::vector<Beam>& beams, const PredictedRanges& predicted) {
  const RobustCost cost = evidenceCost();
  std::vector<float> evidence(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const float wall = predicted.wall[i], open = predicted.open[i];
    evidence[i] = cost(beams[i], wall, open);
    if (beams[i].kind != BeamKind::hit) continue;
    const float hidden = std::min(wall, open) - static_cast<float>(beams[i].range) - kHiddenFrom;
    evidence[i] += kHiddenCost * std::clamp(hidden, 0.0F, kMostHidden);
  }
  return evidence;
}

}  // namespace mrpt_polyloc
