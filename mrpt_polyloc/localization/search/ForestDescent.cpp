#include <mrpt_polyloc/localization/search/ForestDescent.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kBlockLevel = SearchTree::kLevels - 1;

/// Parts take times that differ tenfold, as the scan looks like some places more than like others:
/// with so many a thread none waits long for the last.
constexpr std::size_t kPartsOfThread = 8;

std::size_t countParts(const SearchTree& tree, const Budget& budget, std::size_t max_nodes) {
  const std::size_t threads = budget.threads();
  if (threads == 1 || max_nodes > 0) return 1;
  return std::clamp<std::size_t>(tree.nodes(kBlockLevel).size(), 1, kPartsOfThread * threads);
}

}  // namespace

ForestDescent::ForestDescent(const SearchTree& tree, const BandQuery& query, const PosePrior& prior,
                             const mrpt::math::TPoint2D& sensor, const Budget& budget,
                             std::size_t max_nodes, Workspace& workspace)
    : budget_(&budget), max_nodes_(max_nodes) {
  const std::size_t count = countParts(tree, budget, max_nodes);
  if (workspace.size() < count) workspace.resize(count);
  leaves_.resize(count);
  std::vector<std::optional<TreeDescent>> parts(count);
  const std::size_t blocks = tree.nodes(kBlockLevel).size();
  budget.forEach(count, 1, [&](std::size_t i) {
    const TreeDescent::Range range{static_cast<std::uint32_t>(i * blocks / count),
                                   static_cast<std::uint32_t>((i + 1) * blocks / count)};
    parts[i].emplace(tree, range, query, prior, sensor, workspace[i]);
  });
  parts_.reserve(count);
  for (std::optional<TreeDescent>& part : parts) parts_.push_back(std::move(*part));
}

bool ForestDescent::isDone() const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [](const TreeDescent& part) { return part.isDone(); });
}

bool ForestDescent::expandUpTo(unsigned limit, std::vector<TreeDescent::Node>& leaves) {
  std::vector<char> is_complete(parts_.size(), 0);
  budget_->forEach(parts_.size(), 1, [&](std::size_t i) {
    const auto is_spent = [&] {
      return budget_->isSpent() || (max_nodes_ > 0 && parts_[i].evaluated() >= max_nodes_);
    };
    leaves_[i].clear();
    is_complete[i] = parts_[i].expandUpTo(limit, is_spent, leaves_[i]) ? 1 : 0;
  });
  // Blocks lie in a row, and so do their leaves: this is the order that one part would give.
  for (const auto& of_part : leaves_) leaves.insert(leaves.end(), of_part.begin(), of_part.end());
  return std::all_of(is_complete.begin(), is_complete.end(), [](char is) { return is != 0; });
}

void ForestDescent::greedyDescent(std::size_t width, std::vector<TreeDescent::Node>& leaves) {
  const std::size_t of_part = std::max<std::size_t>(1, width / parts_.size());
  for (TreeDescent& part : parts_) part.greedyDescent(of_part, leaves);
}

std::size_t ForestDescent::countBelow(unsigned bound) const {
  std::size_t sum = 0;
  for (const TreeDescent& part : parts_) sum += part.countBelow(bound);
  return sum;
}

std::size_t ForestDescent::evaluated() const {
  std::size_t sum = 0;
  for (const TreeDescent& part : parts_) sum += part.evaluated();
  return sum;
}

}  // namespace mrpt_polyloc
