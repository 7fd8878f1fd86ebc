#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/CellDescent.h>
#include <mrpt_polyloc/localization/CertifiedSearch.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Node = CellDescent::Node;

/// The scan's cost at the middles of cells: their views, in the directions where the bins begin, as
/// bands without width.
class MiddleCosts {
 public:
  MiddleCosts(const CellTree& tree, const RangePredictor& predictor, const BandQuery& query)
      : tree_(tree), predictor_(predictor), query_(query), pattern_(borders()) {}

  /// For leaves in the order of their cells.
  mrpt::math::TPose2D pose(const Node& leaf) const {
    const TPoint2D p = tree_.middle(leaf.index);
    return {p.x, p.y, query_.heading(leaf.heading)};
  }

  /// [units], at the begin of the leaf's window of headings.
  unsigned cost(const Node& leaf) {
    if (leaf.index != cell_) look(leaf.index);
    return bandCost({near_.data(), wall_.data(), near_.data(), wall_.data()}, query_, leaf.heading);
  }

 private:
  static std::vector<double> borders() {
    std::vector<double> bearings(kBandBins);
    for (std::size_t b = 0; b < kBandBins; ++b) {
      bearings[b] = static_cast<double>(b) * kBandBinWidth;
    }
    return bearings;
  }

  void look(std::uint32_t cell) {
    cell_ = cell;
    const TPoint2D p = tree_.middle(cell);
    predictor_.predict({p.x, p.y, 0.0}, pattern_, ranges_);
    const auto in_units = [](float range) {
      return static_cast<unsigned>(
          std::min(range * static_cast<float>(RangeUnits::kPerMeter), 65534.0F));
    };
    for (std::size_t b = 0; b < CellTree::kStride; ++b) {
      const std::size_t i = b % kBandBins;
      const bool is_open = ranges_.open[i] < ranges_.wall[i];
      near_[b] = static_cast<std::uint16_t>(in_units(std::min(ranges_.wall[i], ranges_.open[i])));
      wall_[b] =
          static_cast<std::uint16_t>((in_units(ranges_.wall[i]) & ~1U) | (is_open ? 1U : 0U));
    }
  }

  const CellTree& tree_;
  const RangePredictor& predictor_;
  const BandQuery& query_;
  BeamPattern pattern_;
  PredictedRanges ranges_;
  std::uint32_t cell_ = static_cast<std::uint32_t>(-1);
  std::array<std::uint16_t, CellTree::kStride + 1> near_{}, wall_{};
};

/// Of the leaves in a place of this size only the best is refined: the others lead to the same
/// optimum.
constexpr double kPlaceSize = 0.3;           // [m]
constexpr std::uint32_t kPlaceHeadings = 3;  // [bins]

std::int64_t placeOf(const mrpt::math::TPose2D& pose, std::uint32_t heading) {
  const auto column = static_cast<std::int64_t>(std::floor(pose.x / kPlaceSize));
  const auto row = static_cast<std::int64_t>(std::floor(pose.y / kPlaceSize));
  return ((column * 1048576) + row) * 128 + static_cast<std::int64_t>(heading / kPlaceHeadings);
}

/// The best leaf of each place, those within the starting margin of the best of all.
std::vector<PoseCandidate> candidatesOf(const std::vector<Node>& leaves, MiddleCosts& middles,
                                        const BandQuery& query,
                                        const CertifiedSearchParams& params) {
  std::vector<unsigned> costs;
  costs.reserve(leaves.size());
  for (const Node& leaf : leaves) costs.push_back(middles.cost(leaf));
  if (costs.empty()) return {};
  const double least = query.meters(*std::min_element(costs.begin(), costs.end()));
  const unsigned limit = query.units(least * (1.0 + params.start_share) + params.start_margin);
  std::unordered_map<std::int64_t, std::size_t> places;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (costs[i] > limit) continue;
    const std::int64_t place = placeOf(middles.pose(leaves[i]), leaves[i].heading);
    const auto [best, is_new] = places.try_emplace(place, i);
    if (!is_new && costs[i] < costs[best->second]) best->second = i;
  }
  std::vector<std::pair<unsigned, std::size_t>> order;
  for (const auto& [place, i] : places) order.emplace_back(costs[i], i);
  std::sort(order.begin(), order.end());
  if (order.size() > params.max_candidates) order.resize(params.max_candidates);
  std::vector<PoseCandidate> candidates;
  for (const auto& [cost, i] : order) {
    candidates.push_back({middles.pose(leaves[i]), query.meters(cost)});
  }
  return candidates;
}

/// Tells when the nodes or the time are used up.
class Budget {
 public:
  explicit Budget(const CertifiedSearchParams& params) : params_(params) {}
  bool isSpent(std::size_t nodes) const {
    if (params_.max_nodes > 0 && nodes >= params_.max_nodes) return true;
    const std::chrono::duration<double, std::milli> spent = Clock::now() - start_;
    return params_.time_budget_ms > 0.0 && spent.count() >= params_.time_budget_ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  const CertifiedSearchParams& params_;
  Clock::time_point start_ = Clock::now();
};

/// All leaves of the blocks within the limit; lowers it to what is reached if the budget ends.
std::vector<Node> leavesWithin(CellDescent& descent, const std::vector<std::vector<Node>>& blocks,
                               const Budget& budget, unsigned& limit) {
  std::vector<Node> leaves;
  for (const std::vector<Node>& block : blocks) {
    if (!leaves.empty() && budget.isSpent(descent.evaluated())) {
      // Blocks come by their least bound, and all of them before this one were looked at.
      for (const Node& node : block) limit = std::min(limit, node.bound - (node.bound > 0));
      break;
    }
    descent.descend(block, limit, leaves);
  }
  return leaves;
}

double leastRefinedCost(const std::vector<PoseCandidate>& candidates,
                        const RefinedCost& refined_cost) {
  constexpr std::size_t kRefined = 5;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(kRefined, candidates.size()); ++i) {
    least = std::min(least, refined_cost(candidates[i].pose_map_beams));
  }
  return least;
}

}  // namespace

void CertifiedSearchParams::check() const {
  requireInRange("margin_share", margin_share, 0.0, 10.0);
  requireInRange("margin", margin, 0.0, 10.0);
  requireInRange("start_share", start_share, 0.0, 100.0);
  requireInRange("start_margin", start_margin, 0.0, 100.0);
  requireInRange("max_candidates", static_cast<double>(max_candidates), 1.0, 1e6);
  requireNotNegative("time_budget_ms", time_budget_ms);
}

CertifiedSearchResult searchCells(const CellTree& tree, const RangePredictor& predictor,
                                  const BandQuery& query, const PosePrior& prior,
                                  const mrpt::math::TPoint2D& sensor,
                                  const RefinedCost& refined_cost,
                                  const CertifiedSearchParams& params) {
  CertifiedSearchResult result;
  const Budget budget(params);
  CellDescent descent(tree, query, prior, sensor);
  const std::vector<std::vector<Node>> blocks = descent.top();
  if (blocks.empty() || query.beams.empty()) return result;
  MiddleCosts middles(tree, predictor, query);
  const auto wanted = [&](double cost) {
    return query.units(cost * (1.0 + params.margin_share) + params.margin);
  };

  // The first limit is below what noise alone costs: few leaves are within it, the right one mostly
  // among them, as bounds are well below costs.
  constexpr double kFirstLimit = 0.02;  // [m]
  double least = std::numeric_limits<double>::infinity();
  unsigned limit = query.units(kFirstLimit), target = limit;
  std::vector<Node> leaves;
  for (;;) {
    unsigned reached = limit;
    leaves = leavesWithin(descent, blocks, budget, reached);
    result.candidates = candidatesOf(leaves, middles, query, params);
    least = std::min(least, leastRefinedCost(result.candidates, refined_cost));
    target = std::isfinite(least) ? wanted(least) : 2 * limit;
    const bool is_done = std::isfinite(least) && target <= limit;
    if (is_done || reached < limit) {
      limit = std::min(reached, target);
      break;
    }
    limit = target;
  }

  result.is_complete = limit >= target;
  result.certified_cost = query.meters(limit);
  result.evaluated = descent.evaluated();
  for (const Node& leaf : leaves) {
    if (leaf.bound > limit) continue;
    result.regions.push_back({leaf.index, static_cast<std::uint16_t>(leaf.heading),
                              static_cast<float>(query.meters(leaf.bound))});
  }
  return result;
}

}  // namespace mrpt_polyloc
