#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/search/CertifiedSearch.h>
#include <mrpt_polyloc/localization/search/TreeDescent.h>
#include <mrpt_polyloc/localization/search/view_cost.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Node = TreeDescent::Node;

/// Of the leaves in a place of this size only the best is refined: the others lead to the same
/// optimum.
constexpr double kPlaceSize = 0.3;           // [m]
constexpr std::uint32_t kPlaceHeadings = 3;  // [bins]

std::int64_t placeOf(const mrpt::math::TPose2D& pose, std::uint32_t heading) {
  const auto column = static_cast<std::int64_t>(std::floor(pose.x / kPlaceSize));
  const auto row = static_cast<std::int64_t>(std::floor(pose.y / kPlaceSize));
  return ((column * 1048576) + row) * 128 + static_cast<std::int64_t>(heading / kPlaceHeadings);
}

/// Leaves with their costs in the middle, and from them where to start refinement.
class SeedPoses {
 public:
  SeedPoses(const SearchTree& tree, const BandQuery& query, const CertifiedSearchParams& params)
      : tree_(tree), query_(query), params_(params) {}

  std::vector<Node> leaves;

  /// Takes the leaves added since.
  void evaluate() {
    for (std::size_t i = costs_.size(); i < leaves.size(); ++i) {
      const SearchTree::View view = tree_.middleView(leaves[i].index);
      constexpr auto kHalfWindow = static_cast<std::uint32_t>(SearchTree::kWindow[0] / 2);
      // The window's middle first; the rest of it where that is not far off.
      const std::uint32_t middle = leaves[i].heading + kHalfWindow;
      costs_.push_back(viewCost(view, query_, middle % kBandBins));
      headings_.push_back(middle % kBandBins);
      least_ = std::min(least_, costs_[i]);
      constexpr double kNotFarOff = 1.2;
      if (costs_[i] > kNotFarOff * limit()) continue;
      for (std::uint32_t heading = leaves[i].heading; heading < middle; ++heading) {
        const float cost = viewCost(view, query_, heading);
        if (cost >= costs_[i]) continue;
        costs_[i] = cost;
        headings_[i] = heading;
      }
      least_ = std::min(least_, costs_[i]);
    }
  }

  /// The best leaf of each place, of those within the starting margin of the best of all.
  std::vector<PoseCandidate> best(std::size_t most) const { return best(most, limit()); }

  /// The same of all leaves, if so few remain that every place can be looked at; else as best().
  /// A middle may cost much although the right pose is near: beside racks what is seen changes
  /// within a hand's breadth.
  std::vector<PoseCandidate> allIfFew(std::size_t most) const {
    constexpr std::size_t kLeavesPerPlace = 4;  // about; more leaves are more places than `most`
    if (leaves.size() <= kLeavesPerPlace * most) {
      std::vector<PoseCandidate> all = best(most + 1, std::numeric_limits<double>::infinity());
      if (all.size() <= most) return all;
    }
    return best(most);
  }

 private:
  std::vector<PoseCandidate> best(std::size_t most, double most_cost) const {
    std::unordered_map<std::int64_t, std::size_t> places;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      if (static_cast<double>(costs_[i]) > most_cost) continue;
      const std::int64_t place = placeOf(pose(i), headings_[i]);
      const auto [found, is_new] = places.try_emplace(place, i);
      if (!is_new && costs_[i] < costs_[found->second]) found->second = i;
    }
    std::vector<std::pair<float, std::size_t>> order;
    for (const auto& [place, i] : places) order.emplace_back(costs_[i], i);
    std::sort(order.begin(), order.end());
    if (order.size() > most) order.resize(most);
    std::vector<PoseCandidate> candidates;
    for (const auto& [cost, i] : order) candidates.push_back({pose(i), static_cast<double>(cost)});
    return candidates;
  }

  double limit() const {
    return static_cast<double>(least_) * (1.0 + params_.seed_share) + params_.seed_margin;
  }
  mrpt::math::TPose2D pose(std::size_t leaf) const {
    const TPoint2D p = tree_.middle(leaves[leaf].index);
    return {p.x, p.y, query_.heading(headings_[leaf])};
  }

  const SearchTree& tree_;
  const BandQuery& query_;
  const CertifiedSearchParams& params_;
  std::vector<float> costs_;             ///< in the middle of the leaves [m]
  std::vector<std::uint32_t> headings_;  ///< of the least cost in the window
  float least_ = std::numeric_limits<float>::infinity();
};

/// The next limit, while it is not known how good the best is.
unsigned grown(unsigned limit) {
  constexpr unsigned kGrowth = 4, kMost = std::numeric_limits<unsigned>::max();
  return limit < kMost / kGrowth ? std::max(kGrowth * limit, 1U) : kMost;
}

/// So many are refined to find how good the best is.
constexpr std::size_t kRefined = 5;

/// The least cost of poses once refined; those seen before are not refined again.
class LeastRefined {
 public:
  explicit LeastRefined(const PoseScorer& scorer) : scorer_(scorer) {}

  double cost() const { return least_; }
  void take(const std::vector<PoseCandidate>& candidates) {
    for (const PoseCandidate& candidate : candidates) {
      const mrpt::math::TPose2D& pose = candidate.pose_map_beams;
      if (!seen_.emplace(pose.x, pose.y, pose.phi).second) continue;
      least_ = std::min(least_, scorer_.costBelow(pose));
    }
  }

 private:
  const PoseScorer& scorer_;
  std::set<std::tuple<double, double, double>> seen_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void CertifiedSearchParams::check() const {
  requireInRange("margin_share", margin_share, 0.0, 10.0);
  requireInRange("margin", margin, 0.0, 10.0);
  requireInRange("seed_share", seed_share, 0.0, 100.0);
  requireInRange("seed_margin", seed_margin, 0.0, 100.0);
  requireInRange("max_candidates", static_cast<double>(max_candidates), 1.0, 1e6);
}

CertifiedSearchResult searchTree(const SearchTree& tree, const BandQuery& query,
                                 const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                 const PoseScorer& scorer, const Budget& budget,
                                 const CertifiedSearchParams& params) {
  CertifiedSearchResult result;
  if (query.beams.empty()) return result;
  thread_local TreeDescent::Workspace workspace;
  TreeDescent descent(tree, query, prior, sensor, workspace);
  const auto is_spent = [&] {
    return budget.isSpent() || (params.max_nodes > 0 && descent.evaluated() >= params.max_nodes);
  };

  // The first limits are below what noise alone costs: few leaves are within them, the right one
  // mostly among them, as bounds are well below costs.
  constexpr double kFirstLimit = 0.01;  // [m]
  constexpr std::size_t kGreedyWidth = 64;
  SeedPoses seeds(tree, query, params);
  LeastRefined refined(scorer);
  std::optional<unsigned> certified;
  unsigned limit = query.units(kFirstLimit);
  for (;;) {
    result.is_complete = descent.expandUpTo(limit, is_spent, seeds.leaves);
    if (!result.is_complete && seeds.leaves.empty()) {
      descent.greedyDescent(kGreedyWidth, seeds.leaves);
    }
    seeds.evaluate();
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
  result.evaluated = descent.evaluated();
  if (!certified) return result;  // not even the first limit was reached: nothing is proven
  result.certified_cost = query.meters(*certified);
  for (const Node& leaf : seeds.leaves) {
    if (leaf.bound > *certified) continue;
    result.regions.push_back({leaf.index, static_cast<std::uint16_t>(leaf.heading),
                              static_cast<float>(query.meters(leaf.bound))});
  }
  return result;
}

}  // namespace mrpt_polyloc
