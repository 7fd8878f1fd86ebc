#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/PyramidSearch.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_set>

namespace mrpt_polyloc {
namespace {

/// A block and a window of headings, the first of which is `heading`.
struct Node {
  std::uint32_t block;
  std::uint16_t heading;
  std::uint8_t level;
};

/// Nodes ordered by an integer bound: a list per value, the first non-empty one found by walking
/// up. Within one bound the last in is the first out, so that a promising node is followed down.
class BucketQueue {
 public:
  explicit BucketQueue(std::size_t bounds) : buckets_(bounds) {}
  void push(unsigned bound, const Node& node) {
    buckets_[bound].push_back(node);
    least_ = std::min<std::size_t>(least_, bound);
  }
  /// False when empty.
  bool pop(unsigned& bound, Node& node) {
    while (least_ < buckets_.size() && buckets_[least_].empty()) ++least_;
    if (least_ == buckets_.size()) return false;
    bound = static_cast<unsigned>(least_);
    node = buckets_[least_].back();
    buckets_[least_].pop_back();
    return true;
  }

 private:
  std::vector<std::vector<Node>> buckets_;
  std::size_t least_ = 0;
};

/// Which nodes may hold a pose that the prior allows.
class PriorTest {
 public:
  PriorTest(const PosePrior& prior, const mrpt::math::TPoint2D& sensor)
      : prior_(prior), sensor_(sensor), offset_(std::hypot(sensor.x, sensor.y)) {}

  bool allows(const SignaturePyramid& pyramid, const Node& node) const {
    const double headings = std::ldexp(1.0, node.level);
    if (prior_.compass) {
      const double half = 0.5 * (headings - 1.0) * headingOfBin(1);
      const double middle = headingOfBin(node.heading) + half;
      // Half a bin of grace: headings between two bins are found from the nearer one.
      const double reach = prior_.compass->tolerance + half + 0.5 * headingOfBin(1);
      if (angleBetween(middle, prior_.compass->heading) > reach) return false;
    }
    if (prior_.near) {
      const mrpt::math::TPoint2D p = pyramid.center(node.level, node.block);
      double x = p.x, y = p.y;
      double reach = prior_.near->radius + pyramid.radius(node.level);
      if (node.level == 0) {
        const double c = std::cos(headingOfBin(node.heading));
        const double s = std::sin(headingOfBin(node.heading));
        x -= c * sensor_.x - s * sensor_.y;
        y -= s * sensor_.x + c * sensor_.y;
        reach += pyramid.spacing();  // found from the nearest lattice pose
      } else {
        reach += offset_ + pyramid.spacing();
      }
      if (std::hypot(x - prior_.near->x, y - prior_.near->y) > reach) return false;
    }
    return true;
  }

 private:
  const PosePrior& prior_;
  mrpt::math::TPoint2D sensor_;
  double offset_;
};

/// One candidate for each cell of this size: neighbours of a good pose are good too, and refinement
/// takes them to one optimum.
constexpr double kCellSize = 0.3;  // [m]
constexpr std::uint16_t kHeadingsPerCell = 4;

/// Lets the first pose of each cell through.
class CellFilter {
 public:
  bool isFirst(const mrpt::math::TPoint2D& p, std::uint16_t heading) {
    const auto column = static_cast<std::int64_t>(std::floor(p.x / kCellSize));
    const auto row = static_cast<std::int64_t>(std::floor(p.y / kCellSize));
    const std::int64_t key =
        ((column * 1048576) + row) * 64 + static_cast<std::int64_t>(heading / kHeadingsPerCell);
    return seen_.insert(key).second;
  }

 private:
  std::unordered_set<std::int64_t> seen_;
};

}  // namespace

void PyramidSearchParams::check() const {
  requireInRange("margin_share", margin_share, 0.0, 10.0);
  requireInRange("margin", margin, 0.0, 63.0);
  requireInRange("max_candidates", static_cast<double>(max_candidates), 1.0, 1e6);
}

PyramidSearchResult searchPyramid(const SignaturePyramid& pyramid, const SignatureQuery& query,
                                  const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                  const PyramidSearchParams& params) {
  PyramidSearchResult result;
  const PriorTest prior_test(prior, sensor);
  BucketQueue queue(63 * kBins + 1);
  unsigned limit = std::numeric_limits<unsigned>::max();
  const auto consider = [&](const Node& node) {
    if (!prior_test.allows(pyramid, node)) return;
    ++result.evaluated;
    const unsigned bound = bandCost(pyramid.band(node.level, node.block), query, node.heading);
    if (bound <= limit) queue.push(bound, node);
  };

  constexpr auto kTop = static_cast<std::uint8_t>(SignaturePyramid::kLevels - 1);
  for (std::uint32_t block = 0; block < pyramid.blocks(kTop).size(); ++block) {
    for (std::size_t heading = 0; heading < kBins; heading += std::size_t{1} << kTop) {
      consider({block, static_cast<std::uint16_t>(heading), kTop});
    }
  }
  CellFilter cells;
  Node node{};
  unsigned bound = 0;
  while (result.candidates.size() < params.max_candidates && queue.pop(bound, node) &&
         bound <= limit) {
    if (node.level == 0) {
      const mrpt::math::TPoint2D p = pyramid.center(0, node.block);
      if (!cells.isFirst(p, node.heading)) continue;
      if (result.candidates.empty()) {
        limit = bound + static_cast<unsigned>(params.margin_share * bound +
                                              params.margin * static_cast<double>(query.used_bins));
      }
      result.candidates.push_back({{p.x, p.y, headingOfBin(node.heading)}, bound});
      continue;
    }
    const SignaturePyramid::Block& block = pyramid.blocks(node.level)[node.block];
    const auto level = static_cast<std::uint8_t>(node.level - 1);
    const auto half_window = static_cast<std::uint16_t>(1U << level);
    for (std::uint32_t i = 0; i < block.child_count; ++i) {
      consider({block.first_child + i, node.heading, level});
      consider(
          {block.first_child + i, static_cast<std::uint16_t>(node.heading + half_window), level});
    }
  }
  return result;
}

}  // namespace mrpt_polyloc
