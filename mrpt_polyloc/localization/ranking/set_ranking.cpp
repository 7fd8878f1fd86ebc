#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/ranking/SetEvidence.h>
#include <mrpt_polyloc/localization/ranking/WayFinder.h>
#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/localization/ranking/set_ranking.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Sorted by cost, of ways that end in nearly one pose only the best.
std::vector<ScoredWay> mergeNear(std::vector<ScoredWay> ways, const HypothesisParams& params) {
  std::stable_sort(ways.begin(), ways.end(),
                   [](const ScoredWay& a, const ScoredWay& b) { return a.cost < b.cost; });
  std::vector<ScoredWay> merged;
  for (ScoredWay& way : ways) {
    const TPose2D& pose = way.now();
    const bool is_new = std::none_of(merged.begin(), merged.end(), [&](const ScoredWay& other) {
      return std::hypot(pose.x - other.now().x, pose.y - other.now().y) < params.merge_distance &&
             angleBetween(pose.phi, other.now().phi) < params.merge_angle;
    });
    if (is_new) merged.push_back(std::move(way));
  }
  return merged;
}

/// Ways at their optimum, and how much worse than they say the wheels are for all of them.
struct RefinedWays {
  std::vector<ScoredWay> ways;  ///< sorted by cost
  double wheel_scale = 1.0;
};

RefinedWays refine(const std::vector<TPose2D>& candidates, const WayFinder& finder,
                   const RankingParams& params, const Budget& budget) {
  RefinedWays refined;
  std::vector<ScoredWay>& ways = refined.ways;
  double least_cost = std::numeric_limits<double>::infinity();
  for (const TPose2D& candidate : candidates) {
    if (!ways.empty() && budget.isSpent()) break;
    std::optional<ScoredWay> found = finder.byScans(candidate, WayFinder::worth(least_cost));
    if (!found) continue;
    least_cost = std::min(least_cost, found->cost);
    ways.push_back(std::move(*found));
  }
  ways = mergeNear(std::move(ways), params.hypotheses);
  constexpr std::size_t kLeastRivals = 20;
  const std::size_t kept = 2 * std::max(params.max_hypotheses, kLeastRivals);
  if (ways.size() > kept) ways.resize(kept);

  refined.wheel_scale = finder.wheelScale(ways);
  // As for one scan: all beams where it may matter.
  const std::size_t worth = WayFinder::worthCount(ways);
  budget.forEach(ways.size(), 1, [&](std::size_t i) {
    if (budget.isSpent()) {
      ways[i].refined.tension /= std::pow(refined.wheel_scale, 2);  // as it is, at that scale
    } else {
      ways[i] = finder.likeliest(ways[i], refined.wheel_scale, i < worth);
    }
  });
  ways = mergeNear(std::move(ways), params.hypotheses);
  return refined;
}

/// The features of the way that counts as the answer: shares over the beams of all scans, the lead
/// by the cost over all, the heading as it is held by all.
MatchFeatures featuresOf(const std::vector<ScoredWay>& ways, const ScoredWay& first,
                         const ScanSet& set, const MomentWeights& weights,
                         const SetEvidence& evidence, const RangePredictor& predictor,
                         const RankingParams& params) {
  MatchFeatures features;
  double sum = 0.0;
  for (std::size_t k = 0; k < set.moments().size(); ++k) {
    const std::vector<RangeScan>& scans = set.moments()[k].scans;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const ScanCost& cost = evidence.costs(k)[i];
      if (scans[i].hitCount() == 0) continue;
      const PoseRefiner refiner(predictor, scans[i], params.refinement);
      std::vector<ScoredPose> by_cost;  // only their costs are looked at, for the lead
      for (std::size_t rank = 0; rank < std::min<std::size_t>(ways.size(), 2); ++rank) {
        by_cost.push_back({{}, ways[rank].cost});
      }
      const ScoredPose here{refiner.at(scans[i].beamFrameFromRobot(first.refined.poses[k])),
                            first.cost};
      const MatchFeatures of_scan = matchFeatures(by_cost, here, cost, BeamSectors(cost.beams()));
      const double weight = weights.weights[k] * static_cast<double>(cost.beamCount());
      features.explained += weight * of_scan.explained;
      features.seen += weight * of_scan.seen;
      features.on_walls += weight * of_scan.on_walls;
      features.lead = of_scan.lead;
      sum += weight;
    }
  }
  if (sum > 0.0) {
    features.explained /= sum;
    features.seen /= sum;
    features.on_walls /= sum;
  }
  // As refinement gives it, before the calibration's factor.
  features.heading = 0.5 * std::log(first.refined.covariance(2, 2)) -
                     std::log(params.hypotheses.calibration.position_factor);
  return features;
}

/// Each independent moment gives the odds of a match once: Bayes' rule for as many scans as the set
/// is worth, of which the features are the mean.
double ofAll(double of_one, double independent) {
  const double some = std::pow(of_one, independent), none = std::pow(1.0 - of_one, independent);
  return some + none > 0.0 ? some / (some + none) : of_one;
}

}  // namespace

Assessment rankCandidates(const std::vector<TPose2D>& candidates, const ScanSet& set,
                          const MomentWeights& weights, const Triangulation& triangulation,
                          const PosePrior& prior, const RangePredictor& predictor,
                          const RankingParams& params, const Budget& budget) {
  const SetEvidence evidence(predictor, set, weights, params.cost, params.hypotheses.evidence);
  const WayFinder finder(predictor, set, weights, evidence, triangulation, prior, params);
  const auto [ways, wheel_scale] = refine(candidates, finder, params, budget);
  Assessment result;
  if (ways.empty()) return result;
  result.wheel_scale = wheel_scale;

  const Calibration& calibration = params.hypotheses.calibration;
  std::vector<SetEvidence::Values> values;
  std::vector<double> against;  // mean evidence, and what the wheels say in its units [m]
  for (const ScoredWay& way : ways) values.push_back(evidence.at(way.refined.poses));
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.size(); ++i) {
    if (evidence.mean(values[i]) < evidence.mean(values[best])) best = i;
  }
  std::vector<double> z_scores;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const double behind =
        standardErrors(evidence.difference(values[best], values[i]), params.hypotheses.mapError());
    const double tension = 0.5 * ways[i].refined.tension / calibration.weight_decay;
    z_scores.push_back(std::max(0.0, behind) + tension);
  }
  const double least = *std::min_element(z_scores.begin(), z_scores.end());
  for (double& z : z_scores) z -= least;
  std::vector<std::size_t> ranks(ways.size());
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  std::stable_sort(ranks.begin(), ranks.end(),
                   [&](std::size_t a, std::size_t b) { return z_scores[a] < z_scores[b]; });

  double sum = 0.0;
  for (const std::size_t i : ranks) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = ways[i].now();
    hypothesis.covariance = params.hypotheses.withMapError(ways[i].refined.covariance);
    hypothesis.cost = ways[i].cost;
    hypothesis.z_score = z_scores[i];
    hypothesis.weight = std::exp(-calibration.weight_decay * z_scores[i]);
    sum += hypothesis.weight;
    result.hypotheses.push_back(hypothesis);
  }
  for (Hypothesis& hypothesis : result.hypotheses) hypothesis.weight /= sum;

  result.features =
      featuresOf(ways, ways[ranks.front()], set, weights, evidence, predictor, params);
  result.match_probability = calibration.matchProbability(*result.features);
  if (result.match_probability < calibration.least_match_probability) {
    result.hypotheses.clear();
    return result;
  }
  result.match_probability = ofAll(result.match_probability, weights.independent);
  const double first_is_right = result.match_probability * result.hypotheses.front().weight;
  result.status = first_is_right >= calibration.unique_probability ? LocalizationStatus::unique
                                                                   : LocalizationStatus::ambiguous;
  if (result.hypotheses.size() > params.max_hypotheses) {
    result.hypotheses.resize(params.max_hypotheses);
  }
  for (const Hypothesis& hypothesis : result.hypotheses) result.listed += hypothesis.weight;
  return result;
}

}  // namespace mrpt_polyloc
