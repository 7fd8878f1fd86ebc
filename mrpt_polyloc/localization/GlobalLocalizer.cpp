#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/PoseRefiner.h>
#include <mrpt_polyloc/localization/PyramidSearch.h>
#include <mrpt_polyloc/localization/RobustCost.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/SignatureQuery.h>
#include <mrpt_polyloc/localization/hypotheses.h>
#include <mrpt_polyloc/localization/search_positions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>

namespace mrpt_polyloc {
double knob(const char* name, double fallback) {
  const char* v = std::getenv(name);
  return v ? std::atof(v) : fallback;
}
namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

void GlobalLocalizerParams::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1000.0);
  requireInRange("threads", threads, 0.0, 1024.0);
}

struct GlobalLocalizer::Impl {
  Impl(PolygonMap m, const GlobalLocalizerParams& p)
      : params(p),
        map(std::move(m)),
        triangulation(map),
        predictor(triangulation, RangePredictor::kCellSize, p.threads),
        pyramid(predictor,
                searchPositions(triangulation, knob("SPACING", 0.1), knob("MARGIN", 0.0)),
                triangulation.box().min, knob("SPACING", 0.1), p.threads),
        build_seconds(watch.seconds()) {}

  Stopwatch watch;
  GlobalLocalizerParams params;
  RobustCostParams cost_params;
  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SignaturePyramid pyramid;
  double build_seconds;
};

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
  constexpr std::size_t kLeastHits = 15;
  LocalizationResult result;
  result.statistics.positions = impl_->pyramid.blocks(0).size();
  if (scan.hitCount() < kLeastHits) return result;

  const Stopwatch search_watch;
  SignatureCosts costs;
  costs.cap_short = static_cast<std::uint8_t>(knob("CS", 20));
  costs.cap_long = static_cast<std::uint8_t>(knob("CL", 32));
  costs.cap_open = static_cast<std::uint8_t>(knob("CO", 10));
  costs.cap_none = static_cast<std::uint8_t>(knob("CN", 6));
  const SignatureQuery query(scan, costs);
  PyramidSearchParams sp;
  sp.margin = knob("MG", 1.0);
  sp.margin_share = knob("MS", 0.15);
  sp.max_candidates = static_cast<std::size_t>(knob("MC", 200));
  const PyramidSearchResult found = searchPyramid(impl_->pyramid, query, prior, scan.sensor(), sp);
  result.statistics.evaluated = found.evaluated;
  result.statistics.search_ms = 1e3 * search_watch.seconds();

  const Stopwatch refinement_watch;
  const PoseRefiner coarse(impl_->predictor, scan, {}, 90);
  const PoseRefiner fine(impl_->predictor, scan);
  RobustCostParams cp;
  cp.tau_short = knob("TS", 0.4);
  cp.tau_long = knob("TL", 0.6);
  cp.tau_open = knob("TO", 0.25);
  cp.tau_none = knob("TN", 0.15);
  const ScanCost cost(impl_->predictor, scan, cp);
  std::vector<RankedPose> poses;
  for (const PoseCandidate& candidate : found.candidates) {
    RefinedPose refined = coarse.refine(candidate.pose_map_beams);
    poses.push_back({refined, cost.mean(refined.pose_map_beams)});
  }
  poses = mergeNearPoses(std::move(poses));
  const std::size_t kept = 2 * impl_->params.max_hypotheses;
  if (poses.size() > kept) poses.resize(kept);
  for (RankedPose& pose : poses) {
    const RefinedPose refined = fine.refine(pose.refined.pose_map_beams);
    const double c = cost.mean(refined.pose_map_beams);
    if (c < pose.cost) pose = {refined, c};
  }
  poses = mergeNearPoses(std::move(poses));
  if (poses.size() > impl_->params.max_hypotheses) poses.resize(impl_->params.max_hypotheses);
  result.statistics.refined = found.candidates.size();

  if (poses.empty() || poses.front().cost > knob("NM", 0.25)) {
    result.status = LocalizationStatus::no_match;
  } else {
    result.status =
        isUnique(poses, cost) ? LocalizationStatus::unique : LocalizationStatus::ambiguous;
    result.hypotheses = toHypotheses(poses, scan);
  }
  result.statistics.refinement_ms = 1e3 * refinement_watch.seconds();
  return result;
}

}  // namespace mrpt_polyloc
