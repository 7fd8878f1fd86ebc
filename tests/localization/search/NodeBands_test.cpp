#include "tests/support/constants.h"
#include <mrpt_polyloc/localization/search/NodeBands.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

/// What a band makes a beam of range z cost at least, uncapped [m].
float bound(const BinBand& band, float z) {
  const float in_gap = std::min(z - band.gap_low, band.gap_high - z);
  return std::max({band.near_low - z, z - band.wall_high, band.hasGap() ? in_gap : 0.0F, 0.0F});
}

/// Of any kind: without a gap, unbounded, no wider than a point.
BinBand randomBand(std::mt19937& random) {
  std::uniform_real_distribution<float> range(0.0F, 10.0F);
  std::vector<float> sorted{range(random), range(random), range(random), range(random)};
  std::sort(sorted.begin(), sorted.end());
  if (random() % 5 == 0) sorted[3] = kInfinityF;
  if (random() % 5 == 0) sorted[1] = sorted[2] = sorted[3] = sorted[0];
  const bool has_gap = random() % 3 != 0;
  return {sorted[0], sorted[3], has_gap ? sorted[1] : 0.0F, has_gap ? sorted[2] : 0.0F,
          random() % 2 == 0};
}

TEST(NodeBands, AUnionBoundsWhatEitherBounds) {
  std::mt19937 random(31);
  std::size_t gaps = 0;
  for (int i = 0; i < 40; ++i) {
    NodeBands a, b;
    for (std::size_t bin = 0; bin < kBandBins; ++bin) {
      a[bin] = randomBand(random);
      b[bin] = randomBand(random);
    }
    const std::size_t shift = random() % 5;
    NodeBands both = b;
    unite(a, shift, both);
    for (std::size_t bin = 0; bin < kBandBins; ++bin) {
      const BinBand &of_a = a[(bin + shift) % kBandBins], &of_b = b[bin];
      gaps += both[bin].hasGap();
      EXPECT_EQ(both[bin].may_be_open, of_a.may_be_open || of_b.may_be_open);
      for (float z = 0.0F; z < 11.0F; z += 0.05F) {
        EXPECT_LE(bound(both[bin], z), std::min(bound(of_a, z), bound(of_b, z)) + 1e-6F);
      }
    }
  }
  EXPECT_GT(gaps, 1000U);
}

TEST(NodeBands, BetweenTwoRangesApartIsAGap) {
  NodeBands a, b;
  a.fill({1.0F, 2.0F, 0.0F, 0.0F, false});
  b.fill({5.0F, 9.0F, 6.0F, 8.5F, false});
  unite(a, 0, b);
  EXPECT_EQ(b[7].near_low, 1.0F);
  EXPECT_EQ(b[7].wall_high, 9.0F);
  EXPECT_EQ(b[7].gap_low, 2.0F);  // wider than that of b
  EXPECT_EQ(b[7].gap_high, 5.0F);
}

TEST(NodeBands, WiderWindowsHoldTheBinsFromTheirFirstOn) {
  NodeBands bands;
  for (std::size_t bin = 0; bin < kBandBins; ++bin) {
    const auto range = static_cast<float>(bin);
    bands[bin] = {range, range, 0.0F, 0.0F, bin == 10};
  }
  doubleWindow(1, bands);
  doubleWindow(2, bands);
  EXPECT_EQ(bands[20].near_low, 20.0F);
  EXPECT_EQ(bands[20].wall_high, 23.0F);
  EXPECT_EQ(bands[178].near_low, 0.0F);  // around the circle
  EXPECT_EQ(bands[178].wall_high, 179.0F);
  for (std::size_t bin = 5; bin < 15; ++bin) {
    EXPECT_EQ(bands[bin].may_be_open, bin >= 7 && bin <= 10) << bin;
  }
}

TEST(NodeBands, OfACellTakeTheWiderGap) {
  RangeBands ranges;
  ranges.wall_low.fill(4.0F);
  ranges.wall_high.fill(9.0F);
  ranges.open_low.fill(1.0F);
  ranges.open_high.fill(1.5F);
  ranges.gap_low.fill(5.0F);
  ranges.gap_high.fill(6.0F);
  ranges.gap_high[3] = 8.0F;
  NodeBands bands;
  bandsOfLeaf(ranges, 20.0, bands);
  EXPECT_EQ(bands[0].near_low, 1.0F);
  EXPECT_EQ(bands[0].wall_high, 9.0F);
  EXPECT_EQ(bands[0].gap_low, 1.5F);  // beyond the open edge, up to the wall
  EXPECT_EQ(bands[0].gap_high, 4.0F);
  EXPECT_EQ(bands[3].gap_low, 5.0F);
  EXPECT_EQ(bands[3].gap_high, 8.0F);
  EXPECT_TRUE(bands[0].may_be_open);
}

TEST(NodeBands, OfALeafForgetWallsThatMayLieBeyondTheHorizon) {
  RangeBands ranges;
  ranges.wall_low.fill(4.0F);
  ranges.wall_high.fill(9.0F);
  ranges.gap_low.fill(0.0F);
  ranges.gap_high.fill(0.0F);
  ranges.open_low.fill(1.0F);
  ranges.open_high.fill(1.5F);
  ranges.open_low[3] = 20.0F;  // behind the wall
  NodeBands bands;
  bandsOfLeaf(ranges, 8.1, bands);
  EXPECT_EQ(bands[0].wall_high, 9.0F);
  bandsOfLeaf(ranges, 7.9, bands);
  EXPECT_TRUE(std::isinf(bands[0].wall_high));
  EXPECT_EQ(bands[0].near_low, 1.0F);
  EXPECT_EQ(bands[3].wall_high, 9.0F);
}

}  // namespace
}  // namespace mrpt_polyloc::test
