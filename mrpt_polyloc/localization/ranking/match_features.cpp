#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/localization/ranking/pose_covariance.h>
#include <mrpt_polyloc/localization/scan/BeamEvidence.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

constexpr double kExplainedWithin = 0.2;  // [m]: furniture that was moved a little still counts
constexpr double kCostFloor = 0.02;       // [m]: what the map itself is off by
constexpr double kMostLead = 1.0;

/// Whether a hit lies near a wall that the map predicts on its beam.
bool isExplained(float range, float wall, float open) {
  // Past an open edge only the wall behind it explains; in free space its end does not.
  const float predicted = range < open ? std::min(wall, open) : wall;
  return static_cast<double>(std::abs(range - predicted)) < kExplainedWithin;
}

/// What the best of many poses of another building costs at most, mostly: stands for the second
/// pose where there is none, as a prior may have left out all others.
constexpr double kChanceCost = 0.2;  // [m]

double leadOf(const std::vector<ScoredPose>& poses) {
  const double second = poses.size() < 2 ? kChanceCost : poses[1].cost;
  const double lead = std::log((second + kCostFloor) / (poses[0].cost + kCostFloor));
  return std::clamp(lead, 0.0, kMostLead);
}

}  // namespace

MatchFeatures matchFeatures(const std::vector<ScoredPose>& poses, const ScoredPose& first,
                            const ScanCost& cost, const BeamSectors& sectors) {
  PredictedRanges predicted;
  cost.predict(first.refined.pose_map_beams, predicted);
  const std::vector<Beam>& beams = cost.beams();
  double longest = 0.0;
  for (const Beam& beam : beams) longest = std::max(longest, beam.range);

  double hits = 0.0, explained = 0.0, seen = 0.0, view = 0.0;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const float wall = predicted.wall[i], open = predicted.open[i];
    const double reach = std::min({static_cast<double>(wall), static_cast<double>(open), longest});
    view += reach;
    seen += std::min(beams[i].range, reach);
    if (beams[i].kind != BeamKind::hit) continue;
    hits += 1.0;
    explained += isExplained(static_cast<float>(beams[i].range), wall, open) ? 1.0 : 0.0;
  }
  MatchFeatures features;
  features.explained = hits > 0.0 ? explained / hits : 0.0;
  features.lead = leadOf(poses);
  features.heading = 0.5 * std::log(covarianceOfBeams(first.refined, sectors.count())(2, 2));
  features.seen = view > 0.0 ? seen / view : 1.0;
  features.on_walls = BeamEvidence(cost).nearness(first.refined.pose_map_beams);
  return features;
}

}  // namespace mrpt_polyloc
