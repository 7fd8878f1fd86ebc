#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/assessment.h>
#include <mrpt_polyloc/localization/search_positions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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

}  // namespace

void GlobalLocalizerParams::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
  requireInRange("threads", threads, 0.0, 1024.0);
  requireInRange("spacing", spacing, 0.01, 10.0);
  cost.check();
  signature.check();
  search.check();
  refinement.check();
  hypotheses.check();
}

struct GlobalLocalizer::Impl {
  Impl(PolygonMap polygon_map, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, RangePredictor::kCellSize, params.threads),
        pyramid(predictor, searchPositions(triangulation, params.spacing), triangulation.box().min,
                params.spacing, params.threads),
        build_seconds(watch.seconds()) {}

  /// Candidates refined with some of the beams, the best of them with all, of these what the prior
  /// allows; sorted by cost.
  std::vector<RankedPose> refine(const std::vector<PoseCandidate>& candidates,
                                 const RangeScan& scan, const PosePrior& prior,
                                 const ScanCost& cost) const;

  Stopwatch watch;
  GlobalLocalizerParams params;
  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SignaturePyramid pyramid;
  double build_seconds;
};

std::vector<RankedPose> GlobalLocalizer::Impl::refine(const std::vector<PoseCandidate>& candidates,
                                                      const RangeScan& scan, const PosePrior& prior,
                                                      const ScanCost& cost) const {
  // Enough beams to come near the optimum; all of them only where it may matter.
  constexpr std::size_t kCoarseBeams = 90;
  const PoseRefiner coarse(predictor, scan, params.refinement, kCoarseBeams);
  const PoseRefiner fine(predictor, scan, params.refinement);
  std::vector<RankedPose> poses;
  poses.reserve(candidates.size());
  for (const PoseCandidate& candidate : candidates) {
    const RefinedPose refined = coarse.refine(candidate.pose_map_beams);
    const auto pose_map_robot = scan.robotFromBeamFrame(refined.pose_map_beams);
    if (!isAllowed(prior, pose_map_robot, params.hypotheses)) continue;
    poses.push_back({refined, cost.mean(refined.pose_map_beams)});
  }
  poses = mergeNearPoses(std::move(poses), params.hypotheses);
  // Rivals count even where they are not asked for: one hypothesis may be all that is returned.
  constexpr std::size_t kLeastRivals = 20;
  const std::size_t kept = std::max(params.max_hypotheses, kLeastRivals);
  if (poses.size() > 2 * kept) poses.resize(2 * kept);
  for (RankedPose& pose : poses) {
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

GlobalLocalizer::GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params) {
  params.check();
  impl_ = std::make_unique<Impl>(std::move(map), params);
}
GlobalLocalizer::~GlobalLocalizer() = default;
GlobalLocalizer::GlobalLocalizer(GlobalLocalizer&&) noexcept = default;

const PolygonMap& GlobalLocalizer::map() const {
  return impl_->map;
}
std::size_t GlobalLocalizer::indexBytes() const {
  return impl_->pyramid.bytes() + impl_->predictor.index().bytes();
}
double GlobalLocalizer::indexBuildSeconds() const {
  return impl_->build_seconds;
}

LocalizationResult GlobalLocalizer::localize(const RangeScan& scan, const PosePrior& prior) const {
  prior.check();
  const GlobalLocalizerParams& params = impl_->params;
  LocalizationResult result;
  result.statistics.positions = impl_->pyramid.blocks(0).size();
  if (scan.hitCount() < params.least_hits) return result;

  const Stopwatch search_watch;
  const SignatureQuery query(scan, params.signature, params.cost.none_share);
  const PyramidSearchResult found =
      searchPyramid(impl_->pyramid, query, prior, scan.sensor(), params.search);
  result.statistics.evaluated = found.evaluated;
  result.statistics.refined = found.candidates.size();
  result.statistics.search_ms = 1e3 * search_watch.seconds();

  const Stopwatch refinement_watch;
  const ScanCost cost(impl_->predictor, scan, params.cost);
  const std::vector<RankedPose> poses = impl_->refine(found.candidates, scan, prior, cost);
  assess(poses, scan, cost, params.hypotheses, params.max_hypotheses, result);
  result.statistics.refinement_ms = 1e3 * refinement_watch.seconds();
  return result;
}

}  // namespace mrpt_polyloc
