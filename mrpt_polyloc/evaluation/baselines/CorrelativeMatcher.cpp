#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/baselines/CorrelativeMatcher.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;

constexpr double kFull = 255.0;  // probabilities are bytes

/// For one row or column: the squared distance transform of Felzenszwalb and Huttenlocher (2012).
void transformLine(std::vector<float>& f, std::vector<float>& out, std::vector<int>& v,
                   std::vector<float>& z) {
  const int n = static_cast<int>(f.size());
  const float infinity = std::numeric_limits<float>::infinity();
  int k = -1;
  for (int q = 0; q < n; ++q) {
    const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
    if (at(q) == infinity) continue;
    float s = -infinity;
    while (k >= 0) {
      const int p = v[static_cast<std::size_t>(k)];
      s = ((at(q) + static_cast<float>(q) * static_cast<float>(q)) -
           (at(p) + static_cast<float>(p) * static_cast<float>(p))) /
          static_cast<float>(2 * q - 2 * p);
      if (s > z[static_cast<std::size_t>(k)]) break;
      --k;
    }
    ++k;
    v[static_cast<std::size_t>(k)] = q;
    z[static_cast<std::size_t>(k)] = k == 0 ? -infinity : s;
    z[static_cast<std::size_t>(k) + 1] = infinity;
  }
  if (k < 0) {
    out = f;
    return;
  }
  int j = 0;
  for (int q = 0; q < n; ++q) {
    while (z[static_cast<std::size_t>(j) + 1] < static_cast<float>(q)) ++j;
    const int p = v[static_cast<std::size_t>(j)];
    const float d = static_cast<float>(q - p);
    out[static_cast<std::size_t>(q)] = d * d + f[static_cast<std::size_t>(p)];
  }
}

/// Squared distance of each cell's middle to the nearest occupied one's [cells2].
std::vector<float> squaredDistances(const OccupancyBitmap& bitmap) {
  const auto width = static_cast<std::size_t>(bitmap.width);
  const auto height = static_cast<std::size_t>(bitmap.height);
  std::vector<float> d(width * height);
  for (std::size_t i = 0; i < d.size(); ++i) {
    d[i] = bitmap.cells[i] == CellState::occupied ? 0.0F : std::numeric_limits<float>::infinity();
  }
  const auto pass = [&](std::size_t lines, std::size_t length, std::size_t line_step,
                        std::size_t step) {
    std::vector<float> f(length), out(length), z(length + 1);
    std::vector<int> v(length);
    for (std::size_t line = 0; line < lines; ++line) {
      for (std::size_t i = 0; i < length; ++i) f[i] = d[line * line_step + i * step];
      transformLine(f, out, v, z);
      for (std::size_t i = 0; i < length; ++i) d[line * line_step + i * step] = out[i];
    }
  };
  pass(width, height, 1, width);
  pass(height, width, width, 1);
  return d;
}

}  // namespace

void CorrelativeMatcherParams::check() const {
  requirePositive("sigma", sigma);
  requireInRange("least_probability", least_probability, 0.0, 1.0);
  requireInRange("levels", levels, 0, 12);
  requirePositive("far_range", far_range);
  requireInRange("most_hits", static_cast<double>(most_hits), 1.0, 1e6);
}

/// Level h holds at (column, row) the greatest byte of cells [column, column + 2^h) x [row, row +
/// 2^h). Its first entry is for (-(2^h - 1), -(2^h - 1)): blocks that only reach into the grid.
struct CorrelativeMatcher::Block {
  int level = 0;
  int column = 0, row = 0;
  std::uint32_t sum = 0;
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
  const std::vector<float> squares = squaredDistances(bitmap);
  std::vector<std::uint8_t> level(squares.size());
  const double scale = resolution_ * resolution_ / (2.0 * params_.sigma * params_.sigma);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const double near = std::exp(-scale * static_cast<double>(squares[i]));
    level[i] =
        static_cast<std::uint8_t>(std::lround(kFull * std::max(near, params_.least_probability)));
  }
  levels_.push_back(std::move(level));
  for (int h = 1; h <= params_.levels; ++h) {
    const int half = 1 << (h - 1);
    const int width = width_ + 2 * half - 1, height = height_ + 2 * half - 1;
    std::vector<std::uint8_t> next(static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height));
    const std::vector<std::uint8_t>& below = levels_.back();
    const int below_width = width_ + half - 1, below_height = height_ + half - 1;
    // Entry (x, y) is for the block from x - (2 half - 1) on; of the level below from x - (half -
    // 1).
    const auto at = [&](int x, int y) -> std::uint8_t {
      if (x < 0 || y < 0 || x >= below_width || y >= below_height) return outside_;
      return below[static_cast<std::size_t>(y) * static_cast<std::size_t>(below_width) +
                   static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int left = x - half, low = y - half;
        next[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x)] =
            std::max(std::max(at(left, low), at(left + half, low)),
                     std::max(at(left, low + half), at(left + half, low + half)));
      }
    }
    levels_.push_back(std::move(next));
  }
}

std::size_t CorrelativeMatcher::bytes() const {
  std::size_t bytes = 0;
  for (const auto& level : levels_) bytes += level.size();
  return bytes;
}

std::vector<TPoint2D> CorrelativeMatcher::scoredHits(const RangeScan& scan) const {
  std::vector<TPoint2D> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    hits.push_back({beam.range * std::cos(beam.bearing), beam.range * std::sin(beam.bearing)});
  }
  if (hits.size() <= params_.most_hits) return hits;
  std::vector<TPoint2D> some;
  for (std::size_t i = 0; i < params_.most_hits; ++i) {
    some.push_back(hits[i * hits.size() / params_.most_hits]);
  }
  return some;
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

std::uint32_t CorrelativeMatcher::sum(int level, const std::vector<Offset>& hits, int column,
                                      int row) const {
  const int reach = (1 << level) - 1;
  const int width = width_ + reach, height = height_ + reach;
  const std::uint8_t* bytes = levels_[static_cast<std::size_t>(level)].data();
  const std::uint32_t outside = outside_;
  std::uint32_t total = 0;
  for (const Offset& hit : hits) {
    const int x = column + hit.column + reach, y = row + hit.row + reach;
    const bool within = static_cast<unsigned>(x) < static_cast<unsigned>(width) &&
                        static_cast<unsigned>(y) < static_cast<unsigned>(height);
    total += within ? bytes[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)]
                    : outside;
  }
  return total;
}

void CorrelativeMatcher::descend(const std::vector<Offset>& hits, const Block& block,
                                 Block& best) const {
  if (block.sum <= best.sum) return;
  if (block.level == 0) {
    best = block;
    return;
  }
  const int half = 1 << (block.level - 1);
  Block children[4];
  int count = 0;
  for (const int up : {0, half}) {
    for (const int right : {0, half}) {
      Block child{block.level - 1, block.column + right, block.row + up, 0};
      if (child.column >= width_ || child.row >= height_) continue;
      child.sum = sum(child.level, hits, child.column, child.row);
      children[count++] = child;
    }
  }
  std::stable_sort(children, children + count,
                   [](const Block& a, const Block& b) { return a.sum > b.sum; });
  for (int i = 0; i < count; ++i) descend(hits, children[i], best);
}

std::optional<BaselineAnswer> CorrelativeMatcher::localize(const RangeScan& scan) const {
  const std::vector<TPoint2D> hits = scoredHits(scan);
  if (hits.empty()) return std::nullopt;
  const auto headings = static_cast<std::size_t>(std::ceil(kTwoPi / angularStep(hits)));
  const auto headingOf = [&](std::size_t i) {
    return kTwoPi * static_cast<double>(i) / static_cast<double>(headings);
  };
  struct Root {
    Block block;
    std::size_t heading;
  };
  const int side = 1 << params_.levels;
  std::vector<Root> roots;
  std::vector<std::vector<Offset>> rotated;
  for (std::size_t i = 0; i < headings; ++i) {
    rotated.push_back(offsets(hits, headingOf(i)));
    for (int row = 0; row < height_; row += side) {
      for (int column = 0; column < width_; column += side) {
        roots.push_back(
            {{params_.levels, column, row, sum(params_.levels, rotated.back(), column, row)}, i});
      }
    }
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [](const Root& a, const Root& b) { return a.block.sum > b.block.sum; });
  Block best;
  std::size_t best_heading = 0;
  for (const Root& root : roots) {
    if (root.block.sum <= best.sum) break;
    const std::uint32_t before = best.sum;
    descend(rotated[root.heading], root.block, best);
    if (best.sum > before) best_heading = root.heading;
  }
  // The sensor stands in the middle of its cell; from the grid's frame to the map's.
  const TPoint2D local{(best.column + 0.5) * resolution_, (best.row + 0.5) * resolution_};
  const double c = std::cos(pose_map_bitmap_.phi), s = std::sin(pose_map_bitmap_.phi);
  const mrpt::math::TPose2D pose_map_beams(
      pose_map_bitmap_.x + c * local.x - s * local.y,
      pose_map_bitmap_.y + s * local.x + c * local.y,
      std::remainder(pose_map_bitmap_.phi + headingOf(best_heading), kTwoPi));
  return BaselineAnswer{scan.robotFromBeamFrame(pose_map_beams),
                        best.sum / (kFull * static_cast<double>(hits.size()))};
}

}  // namespace mrpt_polyloc
