#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/localization/CellDescent.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kTop = CellTree::kLevels - 1;
constexpr auto kBins = static_cast<std::uint32_t>(kBandBins);

std::uint32_t windowOf(std::size_t level) {
  return static_cast<std::uint32_t>(CellTree::kWindow[level]);
}

}  // namespace

CellDescent::CellDescent(const CellTree& tree, const BandQuery& query, const PosePrior& prior,
                         const mrpt::math::TPoint2D& sensor)
    : tree_(&tree),
      query_(&query),
      prior_(&prior),
      sensor_distance_(std::hypot(sensor.x, sensor.y)) {
  for (std::size_t level = 0; level <= kTop; ++level) {
    allowed_[level].resize(kBandBins);
    for (std::uint32_t h = 0; h < kBins; ++h) {
      allowed_[level][h] = allowsHeading(level, h) ? 1 : 0;
    }
  }
}

/// The prior speaks of the robot; its sensor is at most `sensor_distance_` away from it.
bool CellDescent::allowsPosition(std::size_t level, std::uint32_t index) const {
  if (!prior_->near) return true;
  const BoundingBox& box = tree_->box(level, index);
  const double dx = std::max({box.min.x - prior_->near->x, prior_->near->x - box.max.x, 0.0});
  const double dy = std::max({box.min.y - prior_->near->y, prior_->near->y - box.max.y, 0.0});
  return std::hypot(dx, dy) <= prior_->near->radius + sensor_distance_;
}

bool CellDescent::allowsHeading(std::size_t level, std::uint32_t heading) const {
  if (!prior_->compass) return true;
  constexpr double kRounding = 1e-9;
  const double half = 0.5 * windowOf(level);
  return angleBetween(query_->heading(heading + half), prior_->compass->heading) <=
         prior_->compass->tolerance + half * kBandBinWidth + kRounding;
}

void CellDescent::consider(std::size_t level, std::uint32_t index, const CellTree::Bands& bands,
                           std::uint32_t heading, unsigned limit, std::vector<Node>& nodes) {
  if (allowed_[level][heading] == 0) return;
  ++evaluated_;
  const unsigned bound = bandCost(bands, *query_, heading);
  if (bound <= limit) nodes.push_back({index, heading, bound});
}

std::vector<std::vector<CellDescent::Node>> CellDescent::top() {
  std::vector<std::vector<Node>> blocks;
  for (std::uint32_t block = 0; block < tree_->nodes(kTop).size(); ++block) {
    if (!allowsPosition(kTop, block)) continue;
    std::vector<Node> nodes;
    const CellTree::Bands bands = tree_->bands(kTop, block);
    for (std::uint32_t h = 0; h < kBins; h += windowOf(kTop)) {
      consider(kTop, block, bands, h, std::numeric_limits<unsigned>::max(), nodes);
    }
    if (!nodes.empty()) blocks.push_back(std::move(nodes));
  }
  const auto least = [](const std::vector<Node>& nodes) {
    return std::min_element(nodes.begin(), nodes.end(),
                            [](const Node& a, const Node& b) { return a.bound < b.bound; })
        ->bound;
  };
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](const auto& a, const auto& b) { return least(a) < least(b); });
  return blocks;
}

/// Nodes of one index stand together, so that each child's bands are read once.
void CellDescent::expand(std::size_t level, const std::vector<Node>& nodes, unsigned limit,
                         std::vector<Node>& children) {
  const std::uint32_t step = windowOf(level - 1);
  for (std::size_t first = 0, last = 0; first < nodes.size(); first = last) {
    while (last < nodes.size() && nodes[last].index == nodes[first].index) ++last;
    const CellTree::Node& node = tree_->nodes(level)[nodes[first].index];
    for (std::uint32_t child = node.first_child; child < node.first_child + node.child_count;
         ++child) {
      if (!allowsPosition(level - 1, child)) continue;
      const CellTree::Bands bands = tree_->bands(level - 1, child);
      for (std::size_t k = first; k < last; ++k) {
        if (nodes[k].bound > limit) continue;
        const std::uint32_t end = nodes[k].heading + windowOf(level);
        for (std::uint32_t heading = nodes[k].heading; heading < end; heading += step) {
          consider(level - 1, child, bands, heading, limit, children);
        }
      }
    }
  }
}

void CellDescent::descend(const std::vector<Node>& block, unsigned limit,
                          std::vector<Node>& leaves) {
  nodes_ = block;
  for (std::size_t level = kTop; level > 0; --level) {
    std::vector<Node>& to = level == 1 ? leaves : children_;
    if (level > 1) children_.clear();
    expand(level, nodes_, limit, to);
    if (level > 1) std::swap(nodes_, children_);
  }
}

}  // namespace mrpt_polyloc
