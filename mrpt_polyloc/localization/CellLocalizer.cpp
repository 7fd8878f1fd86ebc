#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/answer_threads.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewTree.h>
#include <mrpt_polyloc/localization/nearest_cells/cell_views.h>
#include <mrpt_polyloc/localization/nearest_cells/scan_view.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/polar/CirclePlan.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Poses told apart by a lattice of positions and headings: one of each place is refined.
class DifferentPoses {
 public:
  bool isNew(const TPose2D& pose) {
    constexpr double kSide = 0.3, kSlice = 5.0 * kDegree;  // [m], [rad]
    return seen_
        .insert({std::lround(pose.x / kSide), std::lround(pose.y / kSide),
                 std::lround(pose.phi / kSlice)})
        .second;
  }

 private:
  std::set<std::array<long, 3>> seen_;
};

VisibilityCells makeCells(const PolygonMap& map, const CellLocalizerParams& params) {
  const double range =
      params.range ? *params.range : VisibilityCells::greatestRange(map, params.max_cells);
  return VisibilityCells(map, {params.max_cells, range});
}

}  // namespace

void CellLocalizerParams::check() const {
  requireInRange("threads", threads, 0.0, 1024.0);
  if (range && !(std::isinf(*range) && *range > 0.0)) requirePositive("range", *range);
  requireInRange("max_cells", static_cast<double>(max_cells), 1.0, 1e8);
  requireInRange("spacing", spacing, 0.01, 100.0);
  view.check();
  requireInRange("max_candidates", static_cast<double>(max_candidates), 1.0, 1e6);
  requireInRange("distance_share", distance_share, 1.0, 1e6);
  requireNotNegative("distance_margin", distance_margin);
  cost.check();
  refinement.check();
  hypotheses.check();
}

struct CellLocalizer::Impl {
  Impl(MapIndex::Ptr map_index, const CellLocalizerParams& parameters)
      : params(parameters), index(std::move(map_index)) {
    {  // The cells go before the views come: together they would double the memory.
      const VisibilityCells cells = makeCells(index->map(), params);
      cell_count = cells.size();
      cell_range = cells.range();
      viewpoints = cellViewpoints(cells, params.spacing);
    }
    views.emplace(viewsFrom(viewpoints, index->parts().predictor(), params.view.samples,
                            params.view.range, params.threads));
    if (params.nearest == NearestViews::tree) tree.emplace(*views);
  }

  CellLocalizerParams params;
  MapIndex::Ptr index;
  std::size_t cell_count = 0;
  double cell_range = 0.0;
  std::vector<TPoint2D> viewpoints;
  std::optional<ViewIndex> views;
  std::optional<ViewTree> tree;
};

CellLocalizer::CellLocalizer(MapIndex::Ptr index, CellLocalizerParams params) {
  params.check();
  if (!index) throw InvalidParamsError("index: there is none");
  params.hypotheses = params.hypotheses.of(index->map());
  impl_ = std::make_unique<Impl>(std::move(index), params);
}
CellLocalizer::CellLocalizer(PolygonMap map, CellLocalizerParams params)
    : CellLocalizer(MapIndex::deferred(std::move(map)), std::move(params)) {}
CellLocalizer::~CellLocalizer() = default;
CellLocalizer::CellLocalizer(CellLocalizer&&) noexcept = default;
CellLocalizer& CellLocalizer::operator=(CellLocalizer&&) noexcept = default;

const PolygonMap& CellLocalizer::map() const {
  return impl_->index->map();
}
double CellLocalizer::cellRange() const {
  return impl_->cell_range;
}
std::size_t CellLocalizer::cellCount() const {
  return impl_->cell_count;
}
const ViewIndex& CellLocalizer::views() const {
  return *impl_->views;
}
const std::vector<TPoint2D>& CellLocalizer::viewpoints() const {
  return impl_->viewpoints;
}
std::size_t CellLocalizer::indexBytes() const {
  return impl_->views->bytes() + (impl_->tree ? impl_->tree->bytes() : 0) +
         impl_->viewpoints.capacity() * sizeof(TPoint2D) + impl_->index->bytes();
}

LocalizationResult CellLocalizer::localize(const RangeScan& scan, const PosePrior& prior,
                                           const SearchOptions& options) const {
  prior.check();
  options.check();
  if (options.threads > 1) {
    return inOwnArena(options,
                      [&](const SearchOptions& inside) { return localize(scan, prior, inside); });
  }
  const CellLocalizerParams& params = impl_->params;
  LocalizationResult result;
  result.statistics.positions = impl_->viewpoints.size();
  if (scan.hitCount() < params.least_hits) return result;
  const Stopwatch watch;
  const Budget budget = budgetOf(options);
  const std::optional<ScanView> view = viewOfScan(scan, params.view);
  if (!view) return result;

  ViewIndex::Query query{view->samples, {}, view->reach, {}};
  if (prior.compass) query.rotations = {prior.compass->heading, prior.compass->tolerance};
  if (prior.near) {
    // The sensor is off the robot, and the viewpoint off the sensor.
    const double reach =
        prior.near->radius + std::hypot(scan.sensor().x, scan.sensor().y) + params.spacing;
    const PosePrior::Disk disk = *prior.near;
    query.accepts = [this, disk, reach](std::size_t v) {
      const TPoint2D& p = impl_->viewpoints[v];
      return std::hypot(p.x - disk.x, p.y - disk.y) <= reach;
    };
  }
  std::vector<TPose2D> candidates;
  DifferentPoses different;
  double farthest = std::numeric_limits<double>::infinity();
  const auto take = [&](const ViewIndex::Neighbor& neighbor) {
    if (candidates.empty()) {
      farthest = params.distance_share * neighbor.distance + params.distance_margin;
    }
    if (neighbor.distance > farthest) return false;
    const TPoint2D& p = impl_->viewpoints[neighbor.view];
    TPose2D pose(p.x, p.y, neighbor.rotation);
    pose.normalizePhi();
    if (different.isNew(pose)) candidates.push_back(pose);
    return candidates.size() < params.max_candidates && !budget.isSpent();
  };
  result.statistics.evaluated = impl_->tree && ViewTree::serves(query)
                                    ? impl_->tree->visitNearest(query, take)
                                    : impl_->views->visitNearest(query, take);
  result.statistics.search_ms = 1e3 * watch.seconds();

  const Stopwatch ranking;
  const MapIndexParts& parts = impl_->index->parts();
  const AllowedPoses allowed(parts.triangulation(), prior, scan.sensor());
  LocalizationResult ranked = resultOf(rankCandidates(
      candidates, scan, allowed, parts.predictor(),
      {options.max_hypotheses, params.cost, params.refinement, params.hypotheses}, budget));
  if (ranked.status == LocalizationStatus::unique && budget.isSpent()) {
    ranked.status = LocalizationStatus::ambiguous;  // what was left out may be as good
  }
  ranked.statistics = result.statistics;
  ranked.statistics.refined = candidates.size();
  ranked.statistics.refinement_ms = 1e3 * ranking.seconds();
  return ranked;
}

}  // namespace mrpt_polyloc
