#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/Stopwatch.h>
#include <mrpt_polyloc/localization/candidate_ranking.h>
#include <mrpt_polyloc/localization/search_positions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <utility>
#include <vector>

namespace mrpt_polyloc {

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

  Stopwatch watch;
  GlobalLocalizerParams params;
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
  prior.check();
  const GlobalLocalizerParams& params = impl_->params;
  LocalizationResult result;
  result.statistics.positions = impl_->pyramid.blocks(0).size();
  if (scan.hitCount() < params.least_hits) return result;

  const Stopwatch search_watch;
  const SignatureQuery query(scan, params.signature, params.cost.none_share);
  const PyramidSearchResult found =
      searchPyramid(impl_->pyramid, query, prior, scan.sensor(), params.search);
  const double search_ms = 1e3 * search_watch.seconds();

  std::vector<mrpt::math::TPose2D> candidates;
  candidates.reserve(found.candidates.size());
  for (const PoseCandidate& candidate : found.candidates) {
    candidates.push_back(candidate.pose_map_beams);
  }
  LocalizationResult ranked =
      rankCandidates(candidates, scan, prior, impl_->predictor,
                     {params.max_hypotheses, params.cost, params.refinement, params.hypotheses});
  ranked.statistics.positions = result.statistics.positions;
  ranked.statistics.evaluated = found.evaluated;
  ranked.statistics.search_ms = search_ms;
  return ranked;
}

}  // namespace mrpt_polyloc
