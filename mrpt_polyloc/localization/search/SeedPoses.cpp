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
constexpr auto kHalfWindow = static_cast<std::uint32_t>(SearchTree::kWindow[0] / 2);
constexpr std::size_t kLeavesPerPlace = 4;  // about; more leaves are more places than `most`

std::int64_t placeOf(const TPose2D& pose, std::uint32_t heading) {
  const auto column = static_cast<std::int64_t>(std::floor(pose.x / kPlaceSize));
  const auto row = static_cast<std::int64_t>(std::floor(pose.y / kPlaceSize));
  return ((column * 1048576) + row) * 128 + static_cast<std::int64_t>(heading / kPlaceHeadings);
}

}  // namespace

void SeedPoses::tryAllHeadings(std::size_t i) {
  const SearchTree::View view = tree_.middleView(leaves_[i].index);
  const std::uint32_t middle = leaves_[i].heading + kHalfWindow;
  for (std::uint32_t heading = leaves_[i].heading; heading < middle; ++heading) {
    const float cost = viewCost(view, query_, heading);
    if (cost >= costs_[i]) continue;
    costs_[i] = cost;
    headings_[i] = heading;
  }
}

void SeedPoses::evaluate(const Budget& budget) {
  const std::size_t first = costs_.size(), count = leaves_.size() - first;
  costs_.resize(leaves_.size());
  headings_.resize(leaves_.size());
  constexpr std::size_t kLeastInARow = 256;
  budget.forEach(count, kLeastInARow, [&](std::size_t k) {
    const std::size_t i = first + k;
    const std::uint32_t middle = (leaves_[i].heading + kHalfWindow) % kBandBins;
    costs_[i] = viewCost(tree_.middleView(leaves_[i].index), query_, middle);
    headings_[i] = middle;
  });
  const auto take_least = [&] {
    for (std::size_t i = first; i < costs_.size(); ++i) least_ = std::min(least_, costs_[i]);
  };
  take_least();
  // The rest of the window where its middle is not far off.
  constexpr double kNotFarOff = 1.2;
  const double worth_it = kNotFarOff * limit();
  budget.forEach(count, kLeastInARow, [&](std::size_t k) {
    if (costs_[first + k] <= worth_it) tryAllHeadings(first + k);
  });
  take_least();
}

float SeedPoses::costIfWorthwhile(std::size_t i, float worthwhile) {
  // Half a window of heading changes the cost by no more than a leaf's breadth does, mostly.
  constexpr float kMostByHeading = 0.08F;  // [m]
  const bool is_middle_alone =
      headings_[i] == (leaves_[i].heading + kHalfWindow) % static_cast<std::uint32_t>(kBandBins);
  if (is_middle_alone && costs_[i] > worthwhile && costs_[i] <= worthwhile + kMostByHeading) {
    tryAllHeadings(i);
  }
  return costs_[i];
}

bool SeedPoses::areFew(std::size_t most) const {
  return leaves_.size() <= kLeavesPerPlace * most;
}

std::vector<PoseCandidate> SeedPoses::allIfFew(std::size_t most) const {
  if (areFew(most)) {
    std::vector<PoseCandidate> all = best(most + 1, std::numeric_limits<double>::infinity());
    if (all.size() <= most) return all;
  }
  return best(most);
}

std::size_t SeedPoses::countBelow(unsigned bound) const {
  return static_cast<std::size_t>(
      std::count_if(leaves_.begin(), leaves_.end(),
                    [bound](const TreeDescent::Node& leaf) { return leaf.bound < bound; }));
}

std::vector<PoseCandidate> SeedPoses::best(std::size_t most, double most_cost) const {
  // A heap, for mostly a few of ten thousands are wanted.
  std::vector<std::pair<float, std::size_t>> order;
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    if (static_cast<double>(costs_[i]) <= most_cost) order.emplace_back(costs_[i], i);
  }
  std::make_heap(order.begin(), order.end(), std::greater<>());
  std::unordered_set<std::int64_t> places;
  std::vector<PoseCandidate> candidates;
  while (!order.empty() && candidates.size() < most) {
    std::pop_heap(order.begin(), order.end(), std::greater<>());
    const auto [cost, i] = order.back();
    order.pop_back();
    if (!places.insert(placeOf(pose(i), headings_[i])).second) continue;
    candidates.push_back({pose(i), static_cast<double>(cost)});
  }
  return candidates;
}

double SeedPoses::limit() const {
  return static_cast<double>(least_) * (1.0 + params_.seed_share) + params_.seed_margin;
}

TPose2D SeedPoses::pose(std::size_t i) const {
  const TPoint2D p = middle(i);
  return {p.x, p.y, query_.heading(headings_[i])};
}

}  // namespace mrpt_polyloc
