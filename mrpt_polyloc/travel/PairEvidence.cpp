#include <mrpt_polyloc/travel/PairEvidence.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

std::vector<Beam> beamsOf(const LaserModel& laser) {
  std::vector<Beam> beams;
  for (const double bearing : laser.bearings) {
    beams.push_back({bearing, laser.max_range, BeamKind::no_return});
  }
  return beams;
}

}  // namespace

PairEvidence::PairEvidence(const LaserModel& laser, const HypothesisParams& params, double clutter)
    : params_(params),
      least_error_(std::hypot(params.mapError(), clutter)),
      max_range_(static_cast<float>(laser.max_range)),
      sectors_(beamsOf(laser)),
      nothing_(laser.bearings.size(), 0.0F) {
  params.check();
}

/// What the readings of a band cost at least where another band is predicted [m].
float PairEvidence::cost(float low, float high, float judged_low, float judged_high) const {
  const RobustCostParams& caps = params_.evidence.cost;
  const auto none = judged_high < static_cast<float>(caps.none_share) * max_range_
                        ? static_cast<float>(caps.tau_none)
                        : 0.0F;
  if (low >= max_range_) return none;
  const auto tolerance = static_cast<float>(params_.evidence.tolerance);
  const float beyond = std::min(low - judged_high - tolerance, static_cast<float>(caps.tau_long));
  const float before = std::min(judged_low - high - tolerance, static_cast<float>(caps.tau_short));
  const float hit = std::max(0.0F, std::max(beyond, before));
  return high >= max_range_ ? std::min(hit, none) : hit;
}

double PairEvidence::zScore(const ExpectedReadings& truth, const ExpectedReadings& judged) const {
  std::vector<float> costs(nothing_.size());
  for (std::size_t i = 0; i < costs.size(); ++i) {
    costs[i] = cost(truth.low[i], truth.high[i], judged.low[i], judged.high[i]);
  }
  const PairedDifference difference = sectors_.difference(nothing_, costs);
  return difference.mean / std::hypot(difference.standard_error, least_error_);
}

double PairEvidence::tells(const ExpectedReadings& a, const ExpectedReadings& b) const {
  const double z = std::min(zScore(a, b), zScore(b, a));
  return 1.0 - std::exp(-params_.calibration.weight_decay * z);
}

}  // namespace mrpt_polyloc
