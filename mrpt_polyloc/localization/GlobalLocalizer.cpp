#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/answer_threads.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/search/CertifiedSearch.h>

#include <tbb/parallel_for.h>

#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// What a search could not exclude, as polygons and headings.
std::vector<PoseRegion> regionsOf(const CertifiedSearchResult& found, const SearchTree& tree,
                                  const BandQuery& query) {
  std::vector<PoseRegion> regions;
  for (const RemainingLeaf& remaining : found.regions) {
    const TPoint2D* polygon = tree.polygon(remaining.leaf);
    const double first = remaining.heading;
    const auto window = static_cast<double>(SearchTree::kWindow[0]);
    regions.push_back({{polygon, polygon + tree.polygonSize(remaining.leaf)},
                       query.heading(first),
                       query.heading(first + window),
                       static_cast<double>(remaining.bound)});
  }
  return regions;
}

std::vector<TPose2D> posesOf(const std::vector<PoseCandidate>& candidates) {
  std::vector<TPose2D> poses;
  for (const PoseCandidate& candidate : candidates) poses.push_back(candidate.pose_map_beams);
  return poses;
}

}  // namespace

void GlobalLocalizerParams::check() const {
  cost.check();
  search_cost.check();
  certified.check();
  refinement.check();
  hypotheses.check();
  correlation.check();
  requireInRange("most_searched_scans", static_cast<double>(most_searched_scans), 1.0, 1e3);
  requireInRange("sure_probability", sure_probability, 0.0, 1.0);
}

void SearchOptions::check() const {
  requireInRange("max_hypotheses", static_cast<double>(max_hypotheses), 1.0, 1e6);
  requireNotNegative("time_budget_ms", time_budget_ms);
  requireInRange("threads", threads, 0.0, 1024.0);
}

GlobalLocalizer::GlobalLocalizer(MapIndex::Ptr index, GlobalLocalizerParams params)
    : index_(std::move(index)), params_(std::move(params)) {
  params_.check();
  if (!index_) throw InvalidParamsError("index: there is none");
  params_.hypotheses = params_.hypotheses.of(index_->map());
  index_->parts().tree();
}

GlobalLocalizer::GlobalLocalizer(PolygonMap map, GlobalLocalizerParams params)
    : GlobalLocalizer(MapIndex::build(std::move(map)), std::move(params)) {}

LocalizationResult GlobalLocalizer::localize(const RangeScan& scan, const PosePrior& prior,
                                             const SearchOptions& options) const {
  prior.check();
  options.check();
  if (scan.hitCount() < params_.least_hits) return {};
  if (options.threads > 1) {
    return inOwnArena(options,
                      [&](const SearchOptions& inside) { return localize(scan, prior, inside); });
  }
  const Stopwatch watch;
  const Budget budget = budgetOf(options);
  const MapIndexParts& parts = index_->parts();
  const RangePredictor& predictor = parts.predictor();
  const SearchTree& tree = parts.tree();
  const AllowedPoses allowed(parts.triangulation(), prior, scan.sensor());

  // All poses but those that are proven to cost more.
  const BandQuery query(scan, params_.search_cost, options.metric);
  const PoseScorer scorer(predictor, query, scan.sensor(), allowed, params_.search_cost,
                          params_.refinement);
  const CertifiedSearchResult found =
      searchTree(tree, query, prior, scan.sensor(), scorer, budget, params_.certified);
  const double search_ms = 1e3 * watch.seconds();

  // Refined, merged, ranked; and what they mean.
  HypothesisParams hypotheses = params_.hypotheses;
  hypotheses.unite_valleys = hypotheses.unite_valleys && options.unite_valleys;
  LocalizationResult result = resultOf(rankCandidates(
      posesOf(found.candidates), scan, allowed, predictor,
      {options.max_hypotheses, params_.cost, params_.refinement, hypotheses}, budget));
  if (found.certified_cost) {
    result.certificate = Certificate{*found.certified_cost, found.is_complete, found.regions.size(),
                                     found.settled,         found.least_cost,  found.at_least};
  }
  // What a budget left out, or what is undecided, may be as good.
  const bool is_cut_short = !found.is_complete || found.settled.undecided > 0 || budget.isSpent();
  if (result.status == LocalizationStatus::unique && is_cut_short) {
    result.status = LocalizationStatus::ambiguous;
  }
  if (options.keep_regions) result.regions = regionsOf(found, tree, query);
  result.statistics.positions = tree.nodes(0).size();
  result.statistics.evaluated = found.evaluated;
  result.statistics.refined = found.candidates.size();
  result.statistics.search_ms = search_ms;
  result.statistics.refinement_ms = 1e3 * watch.seconds() - search_ms;
  return result;
}

std::vector<LocalizationResult> GlobalLocalizer::localize(const std::vector<RangeScan>& scans,
                                                          const PosePrior& prior,
                                                          const SearchOptions& options) const {
  std::vector<LocalizationResult> results(scans.size());
  tbb::parallel_for(std::size_t{0}, scans.size(),
                    [&](std::size_t i) { results[i] = localize(scans[i], prior, options); });
  return results;
}

}  // namespace mrpt_polyloc
