#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/search/CertifiedSearch.h>
#include <mrpt_polyloc/localization/search/ForestDescent.h>
#include <mrpt_polyloc/localization/search/SeedPoses.h>
#include <mrpt_polyloc/localization/search/deeper_bottoms.h>
#include <mrpt_polyloc/localization/search/settle_leaves.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

namespace mrpt_polyloc {
namespace {

/// The next limit, while it is not known how good the best is.
unsigned grown(unsigned limit) {
  constexpr unsigned kGrowth = 4, kMost = std::numeric_limits<unsigned>::max();
  return limit < kMost / kGrowth ? std::max(kGrowth * limit, 1U) : kMost;
}

/// So many are refined to find how good the best is.
constexpr std::size_t kRefined = 5;

/// Bounds below this may hide a cost below `meters`.
unsigned leastUnits(const BandQuery& query, double meters) {
  return std::isfinite(meters) ? query.units(meters) : std::numeric_limits<unsigned>::max();
}

bool isCheaper(const PoseCandidate& a, const PoseCandidate& b) {
  return a.cost < b.cost;
}

/// Adds starts that are not there yet: the best by one merit is often the best by the other.
void addNew(std::vector<PoseCandidate>& starts, const std::vector<PoseCandidate>& others) {
  const auto end = static_cast<std::ptrdiff_t>(starts.size());
  for (const PoseCandidate& other : others) {
    const bool is_new =
        std::none_of(starts.begin(), starts.begin() + end, [&other](const PoseCandidate& start) {
          return start.pose_map_beams == other.pose_map_beams;
        });
    if (is_new) starts.push_back(other);
  }
}

/// The least cost of poses once refined; those seen before are not refined again.
class LeastRefined {
 public:
  LeastRefined(const PoseScorer& scorer, const Budget& budget) : scorer_(scorer), budget_(budget) {}

  double cost() const { return least_.cost; }
  const PoseCandidate& pose() const { return least_; }
  void take(const std::vector<PoseCandidate>& candidates) {
    std::vector<mrpt::math::TPose2D> starts;
    for (const PoseCandidate& candidate : candidates) {
      const mrpt::math::TPose2D& pose = candidate.pose_map_beams;
      if (seen_.emplace(pose.x, pose.y, pose.phi).second) starts.push_back(pose);
    }
    std::vector<std::optional<ScoredPose>> ends(starts.size());
    budget_.forEach(starts.size(), 1,
                    [&](std::size_t i) { ends[i] = scorer_.optimumBelow(starts[i]); });
    for (const std::optional<ScoredPose>& end : ends) {
      if (end && end->cost < least_.cost) least_ = {end->refined.pose_map_beams, end->cost};
    }
  }

 private:
  const PoseScorer& scorer_;
  const Budget& budget_;
  std::set<std::tuple<double, double, double>> seen_;
  PoseCandidate least_{{}, std::numeric_limits<double>::infinity()};
};

}  // namespace

void CertifiedSearchParams::check() const {
  requireInRange("margin_share", margin_share, 0.0, 10.0);
  requireInRange("margin", margin, 0.0, 10.0);
  requireInRange("seed_share", seed_share, 0.0, 100.0);
  requireInRange("seed_margin", seed_margin, 0.0, 100.0);
  requireInRange("explained_share", explained_share, 0.0, 100.0);
  requireInRange("max_explained", static_cast<double>(max_explained), 0.0, 1e6);
  requireInRange("max_candidates", static_cast<double>(max_candidates), 1.0, 1e6);
  requireNotNegative("reach", reach);
  requireInRange("max_lowered", static_cast<double>(max_lowered), 1.0, 1e6);
}

CertifiedSearchResult searchTree(const SearchTree& tree, const BandQuery& query,
                                 const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                 const PoseScorer& scorer, const Budget& budget,
                                 const CertifiedSearchParams& params) {
  CertifiedSearchResult result;
  if (query.beams.empty()) return result;
  thread_local ForestDescent::Workspace workspace;
  ForestDescent descent(tree, query, prior, sensor, budget, params.max_nodes, workspace);

  // The first limits are below what noise alone costs: few leaves are within them, the right one
  // mostly among them, as bounds are well below costs.
  constexpr double kFirstLimit = 0.01;  // [m]
  constexpr std::size_t kGreedyWidth = 64;
  SeedPoses seeds(tree, query, params);
  LeastRefined refined(scorer, budget);
  std::optional<unsigned> certified;
  unsigned limit = query.units(kFirstLimit);
  for (;;) {
    result.is_complete = descent.expandUpTo(limit, seeds.leaves());
    if (!result.is_complete && seeds.leaves().empty()) {
      descent.greedyDescent(kGreedyWidth, seeds.leaves());
    }
    seeds.evaluate(budget);
    if (!result.is_complete) break;
    refined.take(seeds.best(kRefined));
    const double least = refined.cost();
    const bool is_found = std::isfinite(least);
    const unsigned target =
        is_found ? query.units(least * (1.0 + params.margin_share) + params.margin) : grown(limit);
    if (target <= limit || descent.isDone()) {
      certified = target;
      break;
    }
    certified = limit;
    limit = std::min(target, grown(limit));
  }

  result.candidates = seeds.allIfFew(params.max_candidates);
  addNew(result.candidates, seeds.mostExplained(params.max_explained));
  result.evaluated = descent.evaluated();
  if (!result.is_complete) {
    // Whatever has not been opened may hold the best.
    const unsigned least = leastUnits(query, refined.cost());
    result.settled.undecided = descent.countBelow(least) + seeds.countBelow(least);
  }
  if (!certified) return result;  // not even the first limit was reached: nothing is proven
  result.certified_cost = query.meters(*certified);
  result.least_cost = refined.cost();
  if (result.is_complete) {
    SettledLeaves settled =
        settleLeaves(seeds, *certified, refined.cost(), query, scorer, budget, params);
    result.settled = settled.counts;
    result.candidates.insert(result.candidates.end(), settled.optima.begin(), settled.optima.end());
    PoseCandidate best = refined.pose();
    if (!settled.optima.empty()) best = std::min(best, settled.optima.front(), isCheaper);
    result.least_cost = best.cost;
    if (std::isfinite(best.cost) && !budget.isSpent()) {
      // Of the best alone: the next two, too, take up to half of a query more, and change no first
      // answer of the seven sets.
      const DeeperBottoms deeper = deeperBottoms({best}, scorer, budget);
      result.least_cost = deeper.least;
      result.candidates.insert(result.candidates.end(), deeper.ends.begin(), deeper.ends.end());
    }
    std::stable_sort(result.candidates.begin(), result.candidates.end(), isCheaper);
  }
  unsigned least_bound = *certified;
  for (const TreeDescent::Node& leaf : seeds.leaves()) {
    if (leaf.bound > *certified) continue;
    least_bound = std::min(least_bound, leaf.bound);
    result.regions.push_back({leaf.index, static_cast<std::uint16_t>(leaf.heading),
                              static_cast<float>(query.meters(leaf.bound))});
  }
  if (result.is_complete) result.at_least = query.meters(least_bound);
  return result;
}

}  // namespace mrpt_polyloc
