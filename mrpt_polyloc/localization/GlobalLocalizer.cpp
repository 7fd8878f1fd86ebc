#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/Stopwatch.h>
#include <mrpt_polyloc/localization/candidate_ranking.h>
#include <mrpt_polyloc/localization/search_index_file.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// What a search could not exclude, as polygons and headings.
std::vector<PoseRegion> regionsOf(const CertifiedSearchResult& found, const CellTree& cells,
                                  const BandQuery& query) {
  std::vector<PoseRegion> regions;
  for (const RemainingCell& remaining : found.regions) {
    const TPoint2D* polygon = cells.polygon(remaining.cell);
    const double first = remaining.heading;
    const auto window = static_cast<double>(CellTree::kWindow[0]);
    regions.push_back({{polygon, polygon + cells.polygonSize(remaining.cell)},
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
  requireInRange("cell_size", cell_size, 0.01, 10.0);
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
        predictor(triangulation, 2.0 * params.cell_size, params.threads),
        cells(triangulation, predictor, {params.cell_size, params.threads}),
        build_seconds(watch.seconds()) {}

  Impl(PolygonMap polygon_map, SearchIndex index, const GlobalLocalizerParams& parameters)
      : params(parameters),
        map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, std::move(index.edges)),
        cells(std::move(index.cells)),
        build_seconds(watch.seconds()) {
    if (predictor.index().lists().cell_size != 2.0 * cells.cellSize()) {
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
  CellTree cells;
  double build_seconds;
};

std::vector<TPose2D> GlobalLocalizer::Impl::search(const RangeScan& scan, const PosePrior& prior,
                                                   LocalizationResult& result) const {
  const BandQuery query(scan, params.search_cost, params.search_metric);
  const RangeScan searched(query.beams, scan.sensor());
  const ScanCost cost(predictor, searched, params.search_cost);
  const PoseRefiner refiner(predictor, searched, params.refinement);
  const auto cost_at = [&](const TPose2D& pose) {
    return params.search_metric == SearchMetric::polar ? cost.polarDistance(pose) : cost.mean(pose);
  };
  const CertifiedSearchResult found = searchCells(
      cells, query, prior, scan.sensor(),
      [&](const TPose2D& pose) {
        return std::min(cost_at(pose), cost_at(refiner.refine(pose).pose_map_beams));
      },
      params.certified);
  result.statistics.positions = cells.nodes(0).size();
  result.statistics.evaluated = found.evaluated;
  result.certificate = Certificate{found.certified_cost, found.is_complete, found.regions.size()};
  if (params.keep_regions) result.regions = regionsOf(found, cells, query);
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
  return impl_->cells.bytes() + impl_->predictor.index().bytes();
}
std::string GlobalLocalizer::serializedIndex() const {
  return serializeIndex(impl_->predictor.index().lists(), impl_->cells.data(), impl_->map.hash());
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
  LocalizationResult result =
      rankCandidates(candidates, scan, prior, impl_->predictor,
                     {params.max_hypotheses, params.cost, params.refinement, params.hypotheses});
  result.certificate = found.certificate;
  // What a budget left out may be as good.
  if (result.status == LocalizationStatus::unique && found.certificate &&
      !found.certificate->is_complete) {
    result.status = LocalizationStatus::ambiguous;
  }
  result.regions = std::move(found.regions);
  result.statistics.positions = found.statistics.positions;
  result.statistics.evaluated = found.statistics.evaluated;
  result.statistics.search_ms = search_ms;
  return result;
}

}  // namespace mrpt_polyloc
