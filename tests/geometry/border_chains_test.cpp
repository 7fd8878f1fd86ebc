#include "tests/support/bitmap_art.h"
#include <mrpt_polyloc/geometry/border_chains.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace mrpt_polyloc::test {
namespace {

using ::testing::SizeIs;

BorderChains trace(const std::vector<std::string>& art) {
  return traceBorders(labelRegions(bitmapFromArt(art), 0, 0));
}

TEST(BorderChains, OneCellIsOneClosedChainCounterclockwise) {
  const BorderChains borders = trace({"###", "#.#", "###"});
  ASSERT_THAT(borders.chains, SizeIs(2));
  const BorderChain& inner = borders.chains[1];
  EXPECT_TRUE(borders.isClosed(inner));
  EXPECT_EQ(inner.left, 0);
  EXPECT_EQ(inner.right, RegionGrid::kOccupied);
  const std::vector<LatticePoint> points(
      borders.points.begin() + static_cast<std::ptrdiff_t>(inner.begin),
      borders.points.begin() + static_cast<std::ptrdiff_t>(inner.end));
  EXPECT_EQ(points, (std::vector<LatticePoint>{{2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}}));
}

TEST(BorderChains, ChainsEndWhereThreeRegionsMeet) {
  // The occupied cell meets free space below and unknown space on the other three sides.
  const BorderChains borders = trace({"?#?", "..."});
  ASSERT_THAT(borders.chains, SizeIs(3));
  for (const BorderChain& chain : borders.chains) {
    EXPECT_FALSE(borders.isClosed(chain));
    const std::set<std::int32_t> ends{borders.first(chain).x, borders.last(chain).x};
    EXPECT_EQ(ends, (std::set<std::int32_t>{2, 4}));
  }
}

TEST(BorderChains, FreeSpaceLiesToTheLeft) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const RegionGrid grid = labelRegions(noiseBitmap(12, 9, 0.5, 0.25, seed), 0, 0);
    const BorderChains borders = traceBorders(grid);
    for (const BorderChain& chain : borders.chains) {
      EXPECT_NE(chain.left, chain.right);
      EXPECT_LT(chain.right, 0);
      const LatticePoint& a = borders.points[chain.begin];
      const LatticePoint& b = borders.points[chain.begin + 1];
      // The cell at the left of the first side.
      const int dx = (b.x > a.x) - (b.x < a.x);
      const int dy = (b.y > a.y) - (b.y < a.y);
      const int column = a.x / kLatticePerCell - (dy > 0 || dx < 0 ? 1 : 0);
      const int row = a.y / kLatticePerCell - (dx < 0 || dy < 0 ? 1 : 0);
      EXPECT_EQ(grid.row(row)[column], chain.left);
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
