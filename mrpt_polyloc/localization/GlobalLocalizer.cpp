#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/CertifiedSearch.h>
#include <mrpt_polyloc/localization/search/PoseScorer.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/localization/search/search_index_file.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// What a search could not exclude, as polygons and headings.
std::vector<PoseRegion> regionsOf(const CertifiedSearchResult& found, const SearchTree& tree,
                                  const BandQuery& query) {
  std::vector<PoseRegion> regions;
  for (const RemainingLeaf& remaining : found.regions) {
    const TPoint2D* polygon = tree.polygon(remaining.leaf);
    const double first = remaining.heading, window = SearchTree::kWindow[0];
    regions.push_back({{polygon, polygon + tree.polygonSize(remaining.leaf)},
                       query.heading(first),
                       query.heading(first + window),
                       static_cast<double>(remaining.bound)});
  }
  return regions;
}

}  // namespace

void GlobalLocalizerParams::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
  requireInRange("threads", threads, 0.0, 1024.0);
  requireInRange("leaf_size", leaf_size, 0.01, 10.0);
  cost.check();
  search_cost.check();
  certified.check();
  refinement.check();
  hypotheses.check();
}

struct GlobalLocalizer::Impl {
  Impl(PolygonMap polygon_map, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, 2.0 * params.leaf_size, params.threads),
        tree(triangulation, predictor, {params.leaf_size, params.threads}),
        build_seconds(watch.seconds()) {}

  Impl(PolygonMap polygon_map, SearchIndex index, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, std::move(index.edges)),
        tree(std::move(index.tree)),
        build_seconds(watch.seconds()) {
    if (predictor.index().lists().square_size != 2.0 * tree.leafSize()) {
      throw InvalidMapError("index: its parts are not of one size");
    }
  }

  /// The poses to be refined, and what is known of the others.
  std::vector<TPose2D> search(const RangeScan& scan, const PosePrior& prior,
                              LocalizationResult& result) const;

  Stopwatch watch;
  GlobalLocalizerParams params;
  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SearchTree tree;
  double build_seconds;
};

std::vector<TPose2D> GlobalLocalizer::Impl::search(const RangeScan& scan, const PosePrior& prior,
                                                   LocalizationResult& result) const {
  const BandQuery query(scan, params.search_cost, params.search_metric);
  const PoseScorer scorer(predictor, query, scan.sensor(), params.search_cost, params.refinement);
  const CertifiedSearchResult found =
      searchTree(tree, query, prior, scan.sensor(), scorer, params.certified);
  result.statistics.positions = tree.nodes(0).size();
  result.statistics.evaluated = found.evaluated;
  result.certificate = Certificate{found.certified_cost, found.is_complete, found.regions.size()};
  if (params.keep_regions) result.regions = regionsOf(found, tree, query);
  std::vector<TPose2D> poses;
  for (const PoseCandidate& candidate : found.candidates) poses.push_back(candidate.pose_map_beams);
  return poses;
}

GlobalLocalizer::GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params) {
  params.check();
  impl_ = std::make_unique<Impl>(std::move(map), params);
}
GlobalLocalizer::GlobalLocalizer(PolygonMap map, const std::string& index, const std::string& file,
                                 GlobalLocalizerParams params) {
  params.check();
  SearchIndex parsed = parseIndex(index, file, map.hash());
  try {
    impl_ = std::make_unique<Impl>(std::move(map), std::move(parsed), params);
  } catch (const InvalidMapError& error) {
    throw FormatError(file, "", error.what());
  } catch (const InvalidParamsError& error) {
    throw FormatError(file, "", error.what());
  }
}
GlobalLocalizer::~GlobalLocalizer() = default;
GlobalLocalizer::GlobalLocalizer(GlobalLocalizer&&) noexcept = default;

const PolygonMap& GlobalLocalizer::map() const {
  return impl_->map;
}
std::size_t GlobalLocalizer::indexBytes() const {
  return impl_->tree.bytes() + impl_->predictor.index().bytes();
}
std::string GlobalLocalizer::serializedIndex() const {
  return serializeIndex(impl_->predictor.index().lists(), impl_->tree.data(), impl_->map.hash());
}
double GlobalLocalizer::indexBuildSeconds() const {
  return impl_->build_seconds;
}

LocalizationResult GlobalLocalizer::localize(const RangeScan& scan, const PosePrior& prior) const {
  prior.check();
  const GlobalLocalizerParams& params = impl_->params;
  LocalizationResult found;
  if (scan.hitCount() < params.least_hits) return found;

  const Stopwatch watch;
  const std::vector<TPose2D> candidates = impl_->search(scan, prior, found);
  const double search_ms = 1e3 * watch.seconds();
  const Stopwatch ranking;
  LocalizationResult result = resultOf(
      rankCandidates(candidates, scan, prior, impl_->predictor,
                     {params.max_hypotheses, params.cost, params.refinement, params.hypotheses}));
  result.statistics = found.statistics;
  result.statistics.search_ms = search_ms;
  result.statistics.refined = candidates.size();
  result.statistics.refinement_ms = 1e3 * ranking.seconds();
  result.certificate = found.certificate;
  // What a budget left out may be as good.
  if (result.status == LocalizationStatus::unique && found.certificate &&
      !found.certificate->is_complete) {
    result.status = LocalizationStatus::ambiguous;
  }
  result.regions = std::move(found.regions);
  return result;
}

}  // namespace mrpt_polyloc
