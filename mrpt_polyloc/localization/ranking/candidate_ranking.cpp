#include <mrpt_polyloc/localization/ranking/assess.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/ranking/hypotheses.h>
#include <mrpt_polyloc/localization/ranking/valleys.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/localization/scan/PoseDescent.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// How many poses to keep, so that there are `most` of them, those of a valley taken for one: a
/// valley of which some poses are missing would fall apart.
std::size_t cutAt(std::size_t most, const std::vector<ScoredPose>& poses, const ScanCost& cost,
                  const HypothesisParams& params) {
  if (!params.unite_valleys) return most;
  const std::vector<std::size_t> valleys = valleysOf(poses, cost, BeamSectors(cost.beams()));
  std::size_t count = 0, kept = 0;
  for (; kept < poses.size(); ++kept) {
    count += valleys[kept] == kept ? 1 : 0;  // the first of its valley
    if (count > most) break;
  }
  return kept;
}

/// Candidates refined with some of the beams, the best of them with all; sorted by cost.
std::vector<ScoredPose> refine(const std::vector<mrpt::math::TPose2D>& candidates,
                               const RangeScan& scan, const AllowedPoses& allowed,
                               const ScanCost& cost, const RangePredictor& predictor,
                               const RankingParams& params, const Budget& budget) {
  // Enough beams and steps to come near the optimum; all of them only where it may matter.
  constexpr std::size_t kCoarseBeams = 90;
  PoseRefinerParams near_enough = params.refinement;
  near_enough.step_tolerance = std::max(near_enough.step_tolerance, 1e-2);  // [m]
  near_enough.turn_tolerance = std::max(near_enough.turn_tolerance, 3e-3);  // [rad]
  const auto cost_at = [&cost](const mrpt::math::TPose2D& pose) { return cost.mean(pose); };
  const PoseRefiner coarse(predictor, scan, near_enough, kCoarseBeams);
  const PoseRefiner fine(predictor, scan, params.refinement);
  const PoseDescent coarse_descent(coarse, allowed, cost_at), fine_descent(fine, allowed, cost_at);
  std::vector<std::optional<ScoredPose>> ends(candidates.size());
  budget.forEach(candidates.size(), 1, [&](std::size_t i) {
    if (!budget.isSpent()) ends[i] = coarse_descent.descend(candidates[i]);
  });
  std::vector<ScoredPose> poses;
  poses.reserve(candidates.size());
  for (const std::optional<ScoredPose>& end : ends) {
    if (end) poses.push_back(*end);
  }
  // Without any time left one pose at least.
  for (std::size_t i = 0; poses.empty() && i < candidates.size(); ++i) {
    const std::optional<ScoredPose> end = coarse_descent.descend(candidates[i]);
    if (end) poses.push_back(*end);
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  // Rivals count even where they are not asked for: one hypothesis may be all that is returned.
  constexpr std::size_t kLeastRivals = 50;
  const std::size_t kept = std::max(params.max_hypotheses, kLeastRivals);
  if (poses.size() > 2 * kept) poses.resize(cutAt(2 * kept, poses, cost, params.hypotheses));
  // Those that cost much more than the best will not become it.
  constexpr double kWorthShare = 1.25, kWorthMargin = 0.03;  // measured, [m]
  const double most_cost = poses.empty() ? 0.0 : kWorthShare * poses.front().cost + kWorthMargin;
  budget.forEach(poses.size(), 1, [&](std::size_t i) {
    ScoredPose& pose = poses[i];
    if (pose.cost > most_cost || budget.isSpent()) return;
    const std::optional<ScoredPose> end = fine_descent.descend(pose.refined.pose_map_beams);
    if (end && end->cost < pose.cost) pose = *end;
  });
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  return poses;
}

}  // namespace

Assessment rankCandidates(const std::vector<mrpt::math::TPose2D>& candidates, const RangeScan& scan,
                          const AllowedPoses& allowed, const RangePredictor& predictor,
                          const RankingParams& params, const Budget& budget) {
  const ScanCost cost(predictor, scan, params.cost);
  return assess(refine(candidates, scan, allowed, cost, predictor, params, budget), scan, cost,
                params.hypotheses, params.max_hypotheses);
}

}  // namespace mrpt_polyloc
