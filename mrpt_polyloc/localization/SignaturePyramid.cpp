#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/localization/RangeCode.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/morton_code.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Arrays of kBins codes per block: near and wall on level 0, low and high of each above.
constexpr std::size_t kLeafArrays = 2;
constexpr std::size_t kBlockArrays = 4;

/// low = min(low, values), high = max(high, values), over the bins and `window` headings: a heading
/// later by one bin sees what is one bin further on.
POLYLOC_HOT_LOOP
void widen(const std::uint8_t* low_of, const std::uint8_t* high_of, std::size_t shift,
           std::uint8_t* low, std::uint8_t* high) {
  for (const std::size_t offset : {std::size_t{0}, shift}) {
    const std::size_t wrap = kBins - offset;
    for (std::size_t i = 0; i < wrap; ++i) {
      low[i] = std::min(low[i], low_of[i + offset]);
      high[i] = std::max(high[i], high_of[i + offset]);
    }
    for (std::size_t i = wrap; i < kBins; ++i) {
      low[i] = std::min(low[i], low_of[i - wrap]);
      high[i] = std::max(high[i], high_of[i - wrap]);
    }
  }
}

}  // namespace

SignaturePyramid::SignaturePyramid(const RangePredictor& predictor,
                                   std::vector<std::pair<std::int32_t, std::int32_t>> positions,
                                   const mrpt::math::TPoint2D& corner, double spacing, int threads)
    : corner_(corner), spacing_(spacing), levels_(kLevels) {
  std::vector<std::pair<std::uint64_t, std::pair<std::int32_t, std::int32_t>>> sorted;
  sorted.reserve(positions.size());
  for (const auto& [column, row] : positions) {
    sorted.push_back(
        {mortonCode(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)),
         {column, row}});
  }
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [code, position] : sorted) {
    levels_[0].blocks.push_back({position.first, position.second, 0, 0});
  }
  predictPositions(predictor, threads);
  for (std::size_t level = 1; level < kLevels; ++level) buildLevel(level);
}

void SignaturePyramid::predictPositions(const RangePredictor& predictor, int threads) {
  std::vector<double> bearings(kBins);
  for (std::size_t i = 0; i < kBins; ++i) bearings[i] = headingOfBin(i);
  const BeamPattern pattern(bearings);
  Level& level = levels_[0];
  level.codes.resize(level.blocks.size() * kLeafArrays * kBins);
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const tbb::blocked_range<std::size_t> all(0, level.blocks.size(), 256);
    tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
      std::vector<mrpt::math::TPose2D> poses;
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        const mrpt::math::TPoint2D p = center(0, i);
        poses.emplace_back(p.x, p.y, 0.0);
      }
      PredictedRanges ranges;
      predictor.predict(poses, pattern, ranges);
      std::uint8_t* codes = level.codes.data() + range.begin() * kLeafArrays * kBins;
      for (std::size_t i = 0; i < poses.size(); ++i, codes += kLeafArrays * kBins) {
        for (std::size_t bin = 0; bin < kBins; ++bin) {
          const float wall = ranges.wall[i * kBins + bin];
          const float open = ranges.open[i * kBins + bin];
          codes[bin] = RangeCode::encode(std::min(open, wall));
          codes[kBins + bin] = RangeCode::encode(wall);
        }
      }
    });
  });
}

void SignaturePyramid::buildLevel(std::size_t l) {
  const std::vector<Block>& children = levels_[l - 1].blocks;
  Level& level = levels_[l];
  for (std::uint32_t child = 0; child < children.size(); ++child) {
    const std::int32_t column = children[child].column >> 1, row = children[child].row >> 1;
    if (level.blocks.empty() || level.blocks.back().column != column ||
        level.blocks.back().row != row) {
      level.blocks.push_back({column, row, child, 0});
    }
    ++level.blocks.back().child_count;
  }

  const std::size_t shift = std::size_t{1} << (l - 1);  // half of this level's window of headings
  level.codes.resize(level.blocks.size() * kBlockArrays * kBins);
  for (std::size_t b = 0; b < level.blocks.size(); ++b) {
    std::uint8_t* near_low = level.codes.data() + b * kBlockArrays * kBins;
    std::uint8_t* near_high = near_low + kBins;
    std::uint8_t* wall_low = near_high + kBins;
    std::uint8_t* wall_high = wall_low + kBins;
    std::fill(near_low, near_low + kBins, std::uint8_t{255});
    std::fill(wall_low, wall_low + kBins, std::uint8_t{255});
    std::fill(near_high, near_high + kBins, std::uint8_t{0});
    std::fill(wall_high, wall_high + kBins, std::uint8_t{0});
    for (std::uint32_t i = 0; i < level.blocks[b].child_count; ++i) {
      const SignatureBand child = band(l - 1, level.blocks[b].first_child + i);
      widen(child.near_low, child.near_high, shift, near_low, near_high);
      widen(child.wall_low, child.wall_high, shift, wall_low, wall_high);
    }
  }
}

SignatureBand SignaturePyramid::band(std::size_t level, std::size_t block) const {
  const std::size_t arrays = level == 0 ? kLeafArrays : kBlockArrays;
  const std::uint8_t* codes = levels_[level].codes.data() + block * arrays * kBins;
  if (level == 0) return {codes, codes, codes + kBins, codes + kBins};
  return {codes, codes + kBins, codes + 2 * kBins, codes + 3 * kBins};
}

mrpt::math::TPoint2D SignaturePyramid::center(std::size_t level, std::size_t block) const {
  const Block& b = levels_[level].blocks[block];
  const double size = std::ldexp(1.0, static_cast<int>(level));  // in positions
  return {corner_.x + spacing_ * ((b.column + 0.5) * size - 0.5),
          corner_.y + spacing_ * ((b.row + 0.5) * size - 0.5)};
}

double SignaturePyramid::radius(std::size_t level) const {
  return spacing_ * std::sqrt(0.5) * (std::ldexp(1.0, static_cast<int>(level)) - 1.0);
}

std::size_t SignaturePyramid::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) {
    sum += level.blocks.size() * sizeof(Block) + level.codes.size();
  }
  return sum;
}

}  // namespace mrpt_polyloc
