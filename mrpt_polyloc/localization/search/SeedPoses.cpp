#include <mrpt_polyloc/localization/search/SeedPoses.h>
#include <mrpt_polyloc/localization/search/view_cost.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_set>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Of the leaves in a place of this size only the best is refined: the others lead to the same
/// optimum.
constexpr double kPlaceSize = 0.3;           // [m]
constexpr std::uint32_t kPlaceHeadings = 3;  // [bins]
constexpr auto kHeadingBins = static_cast<std::uint32_t>(kBandBins);
constexpr auto kHalfWindow = static_cast<std::uint32_t>(SearchTree::kWindow[0] / 2);
constexpr std::size_t kLeavesPerPlace = 4;  // about; more leaves are more places than `most`

std::int64_t placeOf(const TPose2D& pose, std::uint32_t heading) {
  const auto column = static_cast<std::int64_t>(std::floor(pose.x / kPlaceSize));
  const auto row = static_cast<std::int64_t>(std::floor(pose.y / kPlaceSize));
  return ((column * 1048576) + row) * 128 + static_cast<std::int64_t>(heading / kPlaceHeadings);
}

}  // namespace

void SeedPoses::tryHeading(std::size_t i, std::uint32_t heading) {
  const ViewCost cost = viewCost(tree_.middleView(leaves_[i].index), query_, heading);
  search_.take(i, cost.search, heading);
  clipped_.take(i, cost.clipped, heading);
}

void SeedPoses::tryAllHeadings(std::size_t i) {
  const std::uint32_t middle = leaves_[i].heading + kHalfWindow;
  for (std::uint32_t heading = leaves_[i].heading; heading < middle; ++heading) {
    tryHeading(i, heading);
  }
}

void SeedPoses::evaluate(const Budget& budget) {
  const std::size_t first = search_.costs.size(), count = leaves_.size() - first;
  search_.resize(leaves_.size());
  clipped_.resize(leaves_.size());
  const auto take_least = [&](Merits& merits) {
    for (std::size_t i = first; i < merits.costs.size(); ++i) {
      merits.least = std::min(merits.least, merits.costs[i]);
    }
  };
  constexpr std::size_t kLeastInARow = 256;
  budget.forEach(count, kLeastInARow, [&](std::size_t k) {
    tryHeading(first + k, (leaves_[first + k].heading + kHalfWindow) % kHeadingBins);
  });
  take_least(search_);
  take_least(clipped_);
  // The rest of the window where its middle is not far off.
  constexpr double kNotFarOff = 1.2;
  const double search_limit = kNotFarOff * limit(), clipped_limit = kNotFarOff * clippedLimit();
  budget.forEach(count, kLeastInARow, [&](std::size_t k) {
    const std::size_t i = first + k;
    if (static_cast<double>(search_.costs[i]) <= search_limit ||
        static_cast<double>(clipped_.costs[i]) <= clipped_limit) {
      tryAllHeadings(i);
    }
  });
  take_least(search_);
  take_least(clipped_);
}

float SeedPoses::costIfWorthwhile(std::size_t i, float worthwhile) {
  // Half a window of heading changes the cost by no more than a leaf's breadth does, mostly.
  constexpr float kMostByHeading = 0.08F;  // [m]
  const float cost = search_.costs[i];
  const bool is_middle_alone = search_.headings[i] == (leaves_[i].heading + kHalfWindow) %
                                                          static_cast<std::uint32_t>(kBandBins);
  if (is_middle_alone && cost > worthwhile && cost <= worthwhile + kMostByHeading) {
    tryAllHeadings(i);
  }
  return search_.costs[i];
}

bool SeedPoses::areFew(std::size_t most) const {
  return leaves_.size() <= kLeavesPerPlace * most;
}

std::vector<PoseCandidate> SeedPoses::allIfFew(std::size_t most) const {
  if (areFew(most)) {
    std::vector<PoseCandidate> all =
        best(search_, most + 1, std::numeric_limits<double>::infinity());
    if (all.size() <= most) return all;
  }
  return best(most);
}

std::vector<PoseCandidate> SeedPoses::mostExplained(std::size_t most) const {
  return best(clipped_, most, clippedLimit());
}

std::size_t SeedPoses::countBelow(unsigned bound) const {
  return static_cast<std::size_t>(
      std::count_if(leaves_.begin(), leaves_.end(),
                    [bound](const TreeDescent::Node& leaf) { return leaf.bound < bound; }));
}

std::vector<PoseCandidate> SeedPoses::best(const Merits& merits, std::size_t most,
                                           double most_cost) const {
  // A heap, for mostly a few of ten thousands are wanted.
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    const float cost = merits.costs[i];
    if (static_cast<double>(cost) <= most_cost) order.emplace_back(cost, i);
  }
  std::make_heap(order.begin(), order.end(), std::greater<>());
  std::unordered_set<std::int64_t> places;
  std::vector<PoseCandidate> candidates;
  while (!order.empty() && candidates.size() < most) {
    std::pop_heap(order.begin(), order.end(), std::greater<>());
    const auto [cost, i] = order.back();
    order.pop_back();
    const TPose2D at = pose(merits, i);
    if (!places.insert(placeOf(at, merits.headings[i])).second) continue;
    candidates.push_back({at, static_cast<double>(search_.costs[i])});
  }
  return candidates;
}

double SeedPoses::limit() const {
  return static_cast<double>(search_.least) * (1.0 + params_.seed_share) + params_.seed_margin;
}

double SeedPoses::clippedLimit() const {
  return static_cast<double>(clipped_.least) * (1.0 + params_.explained_share);
}

TPose2D SeedPoses::pose(const Merits& merits, std::size_t i) const {
  const TPoint2D p = middle(i);
  return {p.x, p.y, query_.heading(merits.headings[i])};
}

}  // namespace mrpt_polyloc
