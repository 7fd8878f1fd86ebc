#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/ranking/assess.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/ranking/hypotheses.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Whether the prior allows a pose, or one that counts as the same hypothesis: refinement may lead
/// away from where the search was allowed to look.
bool isAllowed(const PosePrior& prior, const mrpt::math::TPose2D& pose_map_robot,
               const HypothesisParams& params) {
  if (prior.compass) {
    const double off = angleBetween(pose_map_robot.phi, prior.compass->heading);
    if (off > prior.compass->tolerance + params.merge_angle) return false;
  }
  if (prior.near) {
    const double away =
        std::hypot(pose_map_robot.x - prior.near->x, pose_map_robot.y - prior.near->y);
    if (away > prior.near->radius + params.merge_distance) return false;
  }
  return true;
}

/// Candidates refined with some of the beams, the best of them with all; sorted by cost.
std::vector<RankedPose> refine(const std::vector<mrpt::math::TPose2D>& candidates,
                               const RangeScan& scan, const PosePrior& prior, const ScanCost& cost,
                               const RangePredictor& predictor, const RankingParams& params) {
  // Enough beams and steps to come near the optimum; all of them only where it may matter.
  constexpr std::size_t kCoarseBeams = 90;
  PoseRefinerParams near_enough = params.refinement;
  near_enough.step_tolerance = std::max(near_enough.step_tolerance, 1e-2);  // [m]
  near_enough.turn_tolerance = std::max(near_enough.turn_tolerance, 3e-3);  // [rad]
  const PoseRefiner coarse(predictor, scan, near_enough, kCoarseBeams);
  const PoseRefiner fine(predictor, scan, params.refinement);
  std::vector<RankedPose> poses;
  poses.reserve(candidates.size());
  for (const mrpt::math::TPose2D& candidate : candidates) {
    const RefinedPose refined = coarse.refine(candidate);
    const auto pose_map_robot = scan.robotFromBeamFrame(refined.pose_map_beams);
    if (!isAllowed(prior, pose_map_robot, params.hypotheses)) continue;
    poses.push_back({refined, cost.mean(refined.pose_map_beams)});
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  // Rivals count even where they are not asked for: one hypothesis may be all that is returned.
  constexpr std::size_t kLeastRivals = 20;
  const std::size_t kept = std::max(params.max_hypotheses, kLeastRivals);
  if (poses.size() > 2 * kept) poses.resize(2 * kept);
  // Those that cost much more than the best will not become it.
  constexpr double kWorthShare = 1.25, kWorthMargin = 0.03;  // measured, [m]
  const double most_cost = poses.empty() ? 0.0 : kWorthShare * poses.front().cost + kWorthMargin;
  for (RankedPose& pose : poses) {
    if (pose.cost > most_cost) break;
    const RefinedPose refined = fine.refine(pose.refined.pose_map_beams);
    const auto pose_map_robot = scan.robotFromBeamFrame(refined.pose_map_beams);
    if (!isAllowed(prior, pose_map_robot, params.hypotheses)) continue;
    const double refined_cost = cost.mean(refined.pose_map_beams);
    if (refined_cost < pose.cost) pose = {refined, refined_cost};
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  if (poses.size() > kept) poses.resize(kept);
  return poses;
}

}  // namespace

Assessment rankCandidates(const std::vector<mrpt::math::TPose2D>& candidates, const RangeScan& scan,
                          const PosePrior& prior, const RangePredictor& predictor,
                          const RankingParams& params) {
  const ScanCost cost(predictor, scan, params.cost);
  const std::vector<RankedPose> poses = refine(candidates, scan, prior, cost, predictor, params);
  return assess(poses, scan, cost, params.hypotheses, params.max_hypotheses);
}

}  // namespace mrpt_polyloc
