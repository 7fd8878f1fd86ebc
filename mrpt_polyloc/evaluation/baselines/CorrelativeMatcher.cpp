#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/baselines/CorrelativeMatcher.h>
#include <mrpt_polyloc/evaluation/baselines/squared_distances.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;

constexpr double kFull = 255.0;  // probabilities are bytes

/// The first hit in each voxel (square) of a side.
std::vector<TPoint2D> firstOfVoxels(const std::vector<TPoint2D>& hits, double side) {
  std::vector<TPoint2D> kept;
  std::set<std::pair<long, long>> taken;
  for (const TPoint2D& hit : hits) {
    if (taken.emplace(std::lround(hit.x / side), std::lround(hit.y / side)).second) {
      kept.push_back(hit);
    }
  }
  return kept;
}

/// Hits thinned by the largest voxels that leave at least so many: near walls are seen by many
/// beams, far ones by few, and each metre of wall should weigh alike.
std::vector<TPoint2D> thinned(const std::vector<TPoint2D>& hits, std::size_t least) {
  if (hits.size() <= least) return hits;
  constexpr double kLargestVoxel = 4.0;  // [m]
  constexpr int kHalvings = 14;          // to a quarter of a millimetre
  double low = 0.0, high = kLargestVoxel;
  std::vector<TPoint2D> kept = hits;
  for (int i = 0; i < kHalvings; ++i) {
    const double side = 0.5 * (low + high);
    std::vector<TPoint2D> some = firstOfVoxels(hits, side);
    if (some.size() >= least) {
      low = side;
      kept = std::move(some);
    } else {
      high = side;
    }
  }
  return kept;
}

/// Another order, in which each stretch has hits of all the scan: a block that does not fit is
/// known early.
std::vector<TPoint2D> interleaved(const std::vector<TPoint2D>& hits) {
  constexpr std::size_t kLanes = 7;
  std::vector<TPoint2D> mixed;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t i = lane; i < hits.size(); i += kLanes) mixed.push_back(hits[i]);
  }
  return mixed;
}

int reachOf(int level) {
  return (1 << level) - 1;
}

}  // namespace

void CorrelativeMatcherParams::check() const {
  requirePositive("sigma", sigma);
  requireInRange("least_probability", least_probability, 0.0, 1.0);
  requireInRange("levels", levels, 0, 12);
  requirePositive("far_range", far_range);
  requireInRange("most_hits", static_cast<double>(most_hits), 1.0, 1e6);
  if (!(beyond_free >= 0.0)) throw InvalidParamsError("beyond_free: must not be negative");
}

/// Positions [column, column + 2^level) x [row, row + 2^level) of a heading; column and row are
/// multiples of 2^level. `sum` bounds their scores.
struct CorrelativeMatcher::Block {
  int level = 0;
  int column = 0, row = 0;
  std::uint32_t sum = 0;
};

struct CorrelativeMatcher::Heading {
  std::vector<Offset> hits;
  std::vector<int> entries;                    ///< the same as distances in a level's entries
  int left = 0, right = 0, low = 0, high = 0;  ///< of all hits
};

/// The four blocks that a block is made of, those that are searched, in no order.
struct CorrelativeMatcher::Children {
  std::array<Block, 4> blocks;
  int count = 0;
};

CorrelativeMatcher::CorrelativeMatcher(const OccupancyBitmap& bitmap,
                                       const CorrelativeMatcherParams& params)
    : width_(bitmap.width),
      height_(bitmap.height),
      resolution_(bitmap.resolution),
      pose_map_bitmap_(bitmap.pose_map_bitmap),
      params_(params) {
  params_.check();
  if (std::count(bitmap.cells.begin(), bitmap.cells.end(), CellState::occupied) == 0) {
    throw InvalidMapError("the grid has no occupied cell");
  }
  outside_ = static_cast<std::uint8_t>(std::lround(kFull * params_.least_probability));
  stride_ = width_ + reachOf(params_.levels + 1);
  const std::vector<float> squares = squaredDistances(bitmap, CellState::occupied);
  std::vector<std::uint8_t> bytes(squares.size());
  const double scale = resolution_ * resolution_ / (2.0 * params_.sigma * params_.sigma);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double near = std::exp(-scale * static_cast<double>(squares[i]));
    bytes[i] =
        static_cast<std::uint8_t>(std::lround(kFull * std::max(near, params_.least_probability)));
  }
  for (int level = 1; level <= params_.levels + 1; ++level) bytes = addLevel(level, bytes);

  const std::vector<float> from_free = squaredDistances(bitmap, CellState::free);
  const double reach = params_.beyond_free / resolution_;
  std::vector<bool> cells(from_free.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = static_cast<double>(from_free[i]) <= reach * reach;
  }
  searched_.push_back(std::move(cells));
  for (int level = 1; level <= params_.levels + 1; ++level) addSearched(level);
  const std::vector<bool>& top = searched_.back();
  if (std::find(top.begin(), top.end(), true) == top.end()) {
    throw InvalidMapError("the grid has no free cell");
  }
}

/// \param below the greatest byte of level - 1 for each block of that level, from the first block
/// on that reaches into the grid; \returns the same of this level
std::vector<std::uint8_t> CorrelativeMatcher::addLevel(int level,
                                                       const std::vector<std::uint8_t>& below) {
  const int half = 1 << (level - 1);
  const int below_width = width_ + reachOf(level - 1), below_height = height_ + reachOf(level - 1);
  const int width = width_ + reachOf(level), height = height_ + reachOf(level);
  // Blocks begin `half` later than those of the level below.
  const auto at = [&](int x, int y) -> std::uint8_t {
    if (x < 0 || y < 0 || x >= below_width || y >= below_height) return outside_;
    return below[static_cast<std::size_t>(y) * static_cast<std::size_t>(below_width) +
                 static_cast<std::size_t>(x)];
  };
  const std::uint32_t outside = outside_ * 0x01010101U;
  std::vector<std::uint32_t> entries(
      static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height) + 1, outside);
  std::vector<std::uint8_t> greatest(static_cast<std::size_t>(width) *
                                     static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::array<std::uint8_t, 4> four = {at(x - half, y - half), at(x, y - half),
                                                at(x - half, y), at(x, y)};
      entries[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
              static_cast<std::size_t>(x)] = four[0] | (std::uint32_t{four[1]} << 8U) |
                                             (std::uint32_t{four[2]} << 16U) |
                                             (std::uint32_t{four[3]} << 24U);
      greatest[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)] = *std::max_element(four.begin(), four.end());
    }
  }
  levels_.push_back(std::move(entries));
  return greatest;
}

void CorrelativeMatcher::addSearched(int level) {
  const auto blocks = [&](int cells, int of_level) {
    return static_cast<std::size_t>((cells + reachOf(of_level)) >> of_level);
  };
  const std::vector<bool>& below = searched_.back();
  const std::size_t below_width = blocks(width_, level - 1), width = blocks(width_, level);
  std::vector<bool> level_searched(width * blocks(height_, level), false);
  for (std::size_t i = 0; i < below.size(); ++i) {
    if (!below[i]) continue;
    const std::size_t x = i % below_width / 2, y = i / below_width / 2;
    level_searched[y * width + x] = true;
  }
  searched_.push_back(std::move(level_searched));
}

bool CorrelativeMatcher::isSearched(int level, int column, int row) const {
  if (column >= width_ || row >= height_) return false;
  const auto width = static_cast<std::size_t>((width_ + reachOf(level)) >> level);
  return searched_[static_cast<std::size_t>(level)][static_cast<std::size_t>(row >> level) * width +
                                                    static_cast<std::size_t>(column >> level)];
}

std::size_t CorrelativeMatcher::bytes() const {
  std::size_t bytes = 0;
  for (const auto& level : levels_) bytes += level.size() * sizeof(std::uint32_t);
  for (const auto& level : searched_) bytes += level.size() / 8;
  return bytes;
}

std::vector<TPoint2D> CorrelativeMatcher::scoredHits(const RangeScan& scan) const {
  std::vector<TPoint2D> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    hits.push_back({beam.range * std::cos(beam.bearing), beam.range * std::sin(beam.bearing)});
  }
  return interleaved(thinned(hits, params_.most_hits));
}

double CorrelativeMatcher::angularStep(const std::vector<TPoint2D>& hits) const {
  double farthest = 0.0;
  for (const TPoint2D& hit : hits) {
    farthest = std::max(farthest, std::min(std::hypot(hit.x, hit.y), params_.far_range));
  }
  const double ratio = resolution_ / std::max(farthest, 2.0 * resolution_);
  return std::acos(1.0 - 0.5 * ratio * ratio);
}

std::vector<CorrelativeMatcher::Offset> CorrelativeMatcher::offsets(
    const std::vector<TPoint2D>& hits, double heading) const {
  const double c = std::cos(heading) / resolution_, s = std::sin(heading) / resolution_;
  std::vector<Offset> cells;
  cells.reserve(hits.size());
  for (const TPoint2D& hit : hits) {
    cells.push_back({static_cast<int>(std::lround(c * hit.x - s * hit.y)),
                     static_cast<int>(std::lround(s * hit.x + c * hit.y))});
  }
  return cells;
}

CorrelativeMatcher::Heading CorrelativeMatcher::headingOf(const std::vector<TPoint2D>& hits,
                                                          double angle) const {
  Heading heading;
  heading.hits = offsets(hits, angle);
  heading.left = heading.right = heading.hits.front().column;
  heading.low = heading.high = heading.hits.front().row;
  for (const Offset& hit : heading.hits) {
    heading.entries.push_back(hit.row * stride_ + hit.column);
    heading.left = std::min(heading.left, hit.column);
    heading.right = std::max(heading.right, hit.column);
    heading.low = std::min(heading.low, hit.row);
    heading.high = std::max(heading.high, hit.row);
  }
  return heading;
}

std::uint32_t CorrelativeMatcher::sum(int level, const std::vector<Offset>& hits, int column,
                                      int row) const {
  // The first of the four blocks of the level above that begins at the same place.
  const int reach = reachOf(level + 1);
  const std::vector<std::uint32_t>& entries = levels_[static_cast<std::size_t>(level)];
  std::uint32_t total = 0;
  for (const Offset& hit : hits) {
    const int x = column + hit.column + reach, y = row + hit.row + reach;
    const bool within = x >= 0 && y >= 0 && x < width_ + reach && y < height_ + reach;
    total += within ? entries[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
                              static_cast<std::size_t>(x)] &
                          0xFFU
                    : outside_;
  }
  return total;
}

/// The sums of a block's four parts over the hits; those that cannot be greater than `least` may
/// be left unfinished, and are then 0.
std::array<std::uint32_t, 4> CorrelativeMatcher::sumsOfParts(const Heading& heading,
                                                             const Block& block,
                                                             std::uint32_t least) const {
  const int reach = reachOf(block.level);
  const int column = block.column + reach, row = block.row + reach;
  const std::vector<std::uint32_t>& entries = levels_[static_cast<std::size_t>(block.level - 1)];
  const bool all_within = column + heading.left >= 0 && row + heading.low >= 0 &&
                          column + heading.right < width_ + reach &&
                          row + heading.high < height_ + reach;
  const std::uint32_t* const base =
      entries.data() + static_cast<std::ptrdiff_t>(row) * stride_ + column;
  const std::size_t count = heading.hits.size(), outside = entries.size() - 1;
  std::array<std::uint32_t, 4> sums{};
  constexpr std::size_t kChunk = 32;  // of hits: their sums fit into 16 bits, see below
  for (std::size_t begin = 0; begin < count; begin += kChunk) {
    const std::size_t end = std::min(count, begin + kChunk);
    std::uint32_t even = 0, odd = 0;  // two sums each
    const auto add = [&](std::uint32_t four) {
      even += four & 0x00FF00FFU;
      odd += (four >> 8U) & 0x00FF00FFU;
    };
    if (all_within) {
      for (std::size_t i = begin; i < end; ++i) add(base[heading.entries[i]]);
    } else {
      for (std::size_t i = begin; i < end; ++i) {
        const int x = column + heading.hits[i].column, y = row + heading.hits[i].row;
        const bool within = x >= 0 && y >= 0 && x < width_ + reach && y < height_ + reach;
        add(entries[within ? static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
                                 static_cast<std::size_t>(x)
                           : outside]);
      }
    }
    sums[0] += even & 0xFFFFU;
    sums[1] += odd & 0xFFFFU;
    sums[2] += even >> 16U;
    sums[3] += odd >> 16U;
    const auto left = static_cast<std::uint32_t>(255 * (count - end));
    if (*std::max_element(sums.begin(), sums.end()) + left <= least) return {};
  }
  return sums;
}

CorrelativeMatcher::Children CorrelativeMatcher::childrenOf(const Heading& heading,
                                                            const Block& block,
                                                            std::uint32_t least) const {
  const int half = 1 << (block.level - 1);
  const std::array<std::uint32_t, 4> sums = sumsOfParts(heading, block, least);
  Children children;
  for (int part = 0; part < 4; ++part) {
    const Block child{block.level - 1, block.column + (part % 2) * half,
                      block.row + (part / 2) * half, sums[static_cast<std::size_t>(part)]};
    if (child.sum > least && isSearched(child.level, child.column, child.row)) {
      children.blocks[static_cast<std::size_t>(children.count++)] = child;
    }
  }
  return children;
}

/// Down to the best child each time.
void CorrelativeMatcher::dive(const Heading& heading, Block block, Block& best) const {
  while (block.level > 0) {
    const Children children = childrenOf(heading, block, best.sum);
    if (children.count == 0) return;
    block = *std::max_element(children.blocks.begin(), children.blocks.begin() + children.count,
                              [](const Block& a, const Block& b) { return a.sum < b.sum; });
  }
  best = block;
}

void CorrelativeMatcher::descend(const Heading& heading, const Block& block, Block& best) const {
  if (block.sum <= best.sum) return;
  if (block.level == 0) {
    best = block;
    return;
  }
  Children children = childrenOf(heading, block, best.sum);
  std::stable_sort(children.blocks.begin(), children.blocks.begin() + children.count,
                   [](const Block& a, const Block& b) { return a.sum > b.sum; });
  for (int i = 0; i < children.count; ++i) {
    descend(heading, children.blocks[static_cast<std::size_t>(i)], best);
  }
}

std::optional<BaselineAnswer> CorrelativeMatcher::localize(const RangeScan& scan) const {
  const std::vector<TPoint2D> hits = scoredHits(scan);
  if (hits.empty()) return std::nullopt;
  const auto count = static_cast<std::size_t>(std::ceil(kTwoPi / angularStep(hits)));
  const auto angleOf = [&](std::size_t i) {
    return kTwoPi * static_cast<double>(i) / static_cast<double>(count);
  };
  struct Root {
    Block block;
    std::size_t heading;
  };
  std::vector<Heading> headings;
  std::vector<Root> roots;
  Block best;
  std::size_t best_heading = 0;
  const int side = 1 << (params_.levels + 1);
  for (std::size_t i = 0; i < count; ++i) {
    headings.push_back(headingOf(hits, angleOf(i)));
    Block first;
    for (int row = 0; row < height_; row += side) {
      for (int column = 0; column < width_; column += side) {
        if (!isSearched(params_.levels + 1, column, row)) continue;
        const Children children =
            childrenOf(headings.back(), {params_.levels + 1, column, row, 0}, best.sum);
        for (int k = 0; k < children.count; ++k) {
          const Block& root = children.blocks[static_cast<std::size_t>(k)];
          roots.push_back({root, i});
          if (root.sum > first.sum) first = root;
        }
      }
    }
    const std::uint32_t before = best.sum;
    if (first.sum > best.sum) dive(headings.back(), first, best);
    if (best.sum > before) best_heading = i;
  }
  roots.erase(std::remove_if(roots.begin(), roots.end(),
                             [&](const Root& root) { return root.block.sum <= best.sum; }),
              roots.end());
  std::stable_sort(roots.begin(), roots.end(),
                   [](const Root& a, const Root& b) { return a.block.sum > b.block.sum; });
  for (const Root& root : roots) {
    if (root.block.sum <= best.sum) break;
    const std::uint32_t before = best.sum;
    descend(headings[root.heading], root.block, best);
    if (best.sum > before) best_heading = root.heading;
  }
  if (best.sum == 0) return std::nullopt;  // nothing is near a wall, and clutter has no probability
  // The sensor stands in the middle of its cell; from the grid's frame to the map's.
  const TPoint2D local{(best.column + 0.5) * resolution_, (best.row + 0.5) * resolution_};
  const double c = std::cos(pose_map_bitmap_.phi), s = std::sin(pose_map_bitmap_.phi);
  const mrpt::math::TPose2D pose_map_beams(
      pose_map_bitmap_.x + c * local.x - s * local.y,
      pose_map_bitmap_.y + s * local.x + c * local.y,
      std::remainder(pose_map_bitmap_.phi + angleOf(best_heading), kTwoPi));
  return BaselineAnswer{scan.robotFromBeamFrame(pose_map_beams),
                        best.sum / (kFull * static_cast<double>(hits.size()))};
}

}  // namespace mrpt_polyloc
