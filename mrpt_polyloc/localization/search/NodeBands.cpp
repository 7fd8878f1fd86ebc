#include <mrpt_polyloc/localization/search/NodeBands.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Interval {
  float low, high;
  float width() const { return high - low; }
};

/// Where a beam's range costs something, in all of a bin.
std::array<Interval, 3> excluded(const BinBand& band) {
  return {
      {{-kInfinity, band.near_low}, {band.gap_low, band.gap_high}, {band.wall_high, kInfinity}}};
}

BinBand unionOf(const BinBand& a, const BinBand& b) {
  BinBand both{std::min(a.near_low, b.near_low), std::max(a.wall_high, b.wall_high), 0.0F, 0.0F,
               a.may_be_open || b.may_be_open};
  // The widest of what both exclude between; also where one is all before the other.
  Interval widest{0.0F, 0.0F};
  for (const Interval& of_a : excluded(a)) {
    for (const Interval& of_b : excluded(b)) {
      const Interval common{std::max(of_a.low, of_b.low), std::min(of_a.high, of_b.high)};
      const bool is_between = common.low >= both.near_low && common.high <= both.wall_high;
      if (is_between && common.width() > widest.width()) widest = common;
    }
  }
  both.gap_low = widest.low;
  both.gap_high = widest.high;
  return both;
}

}  // namespace

void bandsOfLeaf(const RangeBands& ranges, double horizon, NodeBands& bands) {
  constexpr double kLess = 1.0 - 1e-5;  // single precision
  const auto sees = static_cast<float>(kLess * horizon);
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const float near_low = std::min(ranges.wall_low[b], ranges.open_low[b]);
    const float near_high = std::min(ranges.wall_high[b], ranges.open_high[b]);
    const Interval of_walls{ranges.gap_low[b], ranges.gap_high[b]};
    const Interval beyond_open{near_high, ranges.wall_low[b]};
    const Interval& gap = beyond_open.width() > of_walls.width() ? beyond_open : of_walls;
    const bool may_be_open =
        ranges.open_low[b] <= ranges.wall_high[b] && std::isfinite(ranges.open_low[b]);
    const bool is_known = !may_be_open || ranges.wall_high[b] <= ranges.open_low[b] + sees;
    const float wall_high = is_known ? ranges.wall_high[b] : kInfinity;
    bands[b] = {near_low, wall_high, gap.low, gap.high, may_be_open};
  }
}

void unite(const NodeBands& from, std::size_t shift, NodeBands& to) {
  for (std::size_t b = 0; b < kBandBins; ++b) {
    to[b] = unionOf(to[b], from[(b + shift) % kBandBins]);
  }
}

void doubleWindow(std::size_t window, NodeBands& bands) {
  const NodeBands before = bands;
  unite(before, window, bands);
}

}  // namespace mrpt_polyloc
