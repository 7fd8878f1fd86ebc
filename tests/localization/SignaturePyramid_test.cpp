#include "lattice_costs.h"
#include <mrpt_polyloc/localization/PyramidSearch.h>
#include <mrpt_polyloc/localization/RangeCode.h>

#include <gtest/gtest.h>

#include <set>

namespace mrpt_polyloc::test {
namespace {

/// The positions (indices of level 0) of a block: one run.
std::pair<std::size_t, std::size_t> positionsOf(const SignaturePyramid& pyramid, std::size_t level,
                                                std::size_t block) {
  std::size_t first = block, last = block + 1;
  for (; level > 0; --level) {
    const auto& end = pyramid.blocks(level)[last - 1];
    first = pyramid.blocks(level)[first].first_child;
    last = end.first_child + end.child_count;
  }
  return {first, last};
}

class SignaturePyramidOnMaps : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  PyramidOfMap built_{smallBuilding(GetParam())};
  const SignaturePyramid& pyramid_ = built_.pyramid;
};

TEST_P(SignaturePyramidOnMaps, PositionsHoldTheCodesOfThePredictedRanges) {
  std::vector<double> bearings(kBins);
  for (std::size_t i = 0; i < kBins; ++i) bearings[i] = headingOfBin(i);
  const BeamPattern pattern(bearings);
  const BruteForceRays rays(built_.map);
  PredictedRanges ranges;
  std::size_t apart = 0, compared = 0;
  for (std::size_t i = 0; i < pyramid_.blocks(0).size(); i += 7) {
    const TPoint2D p = pyramid_.center(0, i);
    built_.predictor.predict({p.x, p.y, 0}, pattern, ranges);
    const SignatureBand band = pyramid_.band(0, i);
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      EXPECT_EQ(band.near_low, band.near_high);
      EXPECT_EQ(band.wall_low, band.wall_high);
      EXPECT_EQ(band.wall_low[bin], RangeCode::encode(ranges.wall[bin]));
      EXPECT_EQ(band.near_low[bin],
                RangeCode::encode(std::min(ranges.wall[bin], ranges.open[bin])));
      const RayHit hit = rays.cast(p, headingOfBin(bin));
      apart += std::abs(band.wall_low[bin] - RangeCode::encode(static_cast<float>(hit.wall))) > 1;
      ++compared;
    }
  }
  EXPECT_LT(static_cast<double>(apart), 2e-3 * static_cast<double>(compared));  // grazing beams
}

TEST_P(SignaturePyramidOnMaps, EachLevelHoldsEveryPositionOnceWithinItsBlocksRadius) {
  const std::size_t count = pyramid_.blocks(0).size();
  ASSERT_EQ(count, searchPositions(built_.triangulation, PyramidOfMap::kSpacing).size());
  for (std::size_t level = 0; level < SignaturePyramid::kLevels; ++level) {
    std::size_t next = 0;
    std::set<std::pair<std::int32_t, std::int32_t>> places;
    for (std::size_t block = 0; block < pyramid_.blocks(level).size(); ++block) {
      const auto [first, last] = positionsOf(pyramid_, level, block);
      EXPECT_EQ(first, next);
      next = last;
      const TPoint2D center = pyramid_.center(level, block);
      for (std::size_t i = first; i < last; ++i) {
        const TPoint2D p = pyramid_.center(0, i);
        EXPECT_LE(std::hypot(p.x - center.x, p.y - center.y), pyramid_.radius(level) + 1e-9);
      }
      const auto& b = pyramid_.blocks(level)[block];
      EXPECT_TRUE(places.emplace(b.column, b.row).second);
    }
    EXPECT_EQ(next, count);
  }
}

TEST_P(SignaturePyramidOnMaps, CostOfAPositionIsTheNaiveOne) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const SignatureQuery query(roughScan(built_.map, seed));
    const std::vector<unsigned> costs = latticeCosts(pyramid_, query);
    for (std::size_t i = 0; i < pyramid_.blocks(0).size(); ++i) {
      for (std::size_t heading = 0; heading < kBins; ++heading) {
        ASSERT_EQ(bandCost(pyramid_.band(0, i), query, heading), costs[i * kBins + heading])
            << i << " " << heading;
      }
    }
  }
}

TEST_P(SignaturePyramidOnMaps, BoundOfABlockIsAtMostTheCostOfEveryPoseInIt) {
  for (std::uint32_t seed = 10; seed < 14; ++seed) {
    const SignatureQuery query(roughScan(built_.map, seed));
    const std::vector<unsigned> costs = latticeCosts(pyramid_, query);
    for (std::size_t level = 1; level < SignaturePyramid::kLevels; ++level) {
      const std::size_t window = std::size_t{1} << level;
      std::size_t useful = 0;
      for (std::size_t block = 0; block < pyramid_.blocks(level).size(); ++block) {
        const auto [first, last] = positionsOf(pyramid_, level, block);
        for (std::size_t heading = 0; heading < kBins; heading += window) {
          unsigned least = ~0U;
          for (std::size_t i = first; i < last; ++i) {
            for (std::size_t h = heading; h < heading + window; ++h) {
              least = std::min(least, costs[i * kBins + h]);
            }
          }
          const unsigned bound = bandCost(pyramid_.band(level, block), query, heading);
          ASSERT_LE(bound, least) << level << " " << block << " " << heading;
          useful += bound > 0;
        }
      }
      EXPECT_GT(useful, 0U) << "every bound of level " << level << " is trivial";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SignaturePyramidOnMaps, ::testing::Values(0U, 1U, 2U, 3U));

TEST(SignaturePyramid, DoesNotDependOnThreads) {
  const PolygonMap map = smallBuilding(4);
  const Triangulation triangulation(map);
  const RangePredictor predictor(triangulation, RangePredictor::kCellSize, 2);
  const auto positions = searchPositions(triangulation, 0.1);
  const SignaturePyramid one(predictor, positions, triangulation.box().min, 0.1, 1);
  const SignaturePyramid two(predictor, positions, triangulation.box().min, 0.1, 2);
  ASSERT_EQ(one.bytes(), two.bytes());
  for (std::size_t level = 0; level < SignaturePyramid::kLevels; ++level) {
    for (std::size_t i = 0; i < one.blocks(level).size(); ++i) {
      const SignatureBand a = one.band(level, i), b = two.band(level, i);
      ASSERT_TRUE(std::equal(a.near_low, a.near_low + kBins, b.near_low)) << level << " " << i;
      ASSERT_TRUE(std::equal(a.wall_high, a.wall_high + kBins, b.wall_high)) << level << " " << i;
    }
  }
}

TEST(SignaturePyramid, OfNoPositions) {
  const Triangulation triangulation(squareMap());
  const RangePredictor predictor(triangulation, RangePredictor::kCellSize, 1);
  const SignaturePyramid pyramid(predictor, {}, {0, 0}, 0.1, 1);
  EXPECT_EQ(pyramid.bytes(), 0U);
  const SignatureQuery query(roughScan(squareMap(), 1));
  EXPECT_TRUE(searchPyramid(pyramid, query, {}, {0, 0}).candidates.empty());
}

TEST(SignaturePyramid, TakesNegativeLatticePoints) {
  const Triangulation triangulation(squareMap(2.0));
  const RangePredictor predictor(triangulation, RangePredictor::kCellSize, 1);
  std::vector<std::pair<std::int32_t, std::int32_t>> positions;
  for (std::int32_t column = -4; column <= 4; ++column) {
    for (std::int32_t row = -4; row <= 4; ++row) positions.emplace_back(column, row);
  }
  const SignaturePyramid pyramid(predictor, positions, {1, 1}, 0.2, 1);
  for (std::size_t level = 0; level < SignaturePyramid::kLevels; ++level) {
    std::size_t count = 0;
    for (std::size_t block = 0; block < pyramid.blocks(level).size(); ++block) {
      const auto [first, last] = positionsOf(pyramid, level, block);
      count += last - first;
      for (std::size_t i = first; i < last; ++i) {
        const TPoint2D p = pyramid.center(0, i), c = pyramid.center(level, block);
        EXPECT_LE(std::hypot(p.x - c.x, p.y - c.y), pyramid.radius(level) + 1e-9);
      }
    }
    EXPECT_EQ(count, positions.size());
  }
  EXPECT_EQ(pyramid.blocks(SignaturePyramid::kLevels - 1).size(), 4U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
