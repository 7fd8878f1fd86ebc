#include "tests/support/bitmap_art.h"
#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

/// Components as letters, from the top row down.
std::vector<std::string> drawn(const RegionGrid& grid) {
  std::vector<std::string> lines;
  for (int y = grid.height() - 1; y >= 0; --y) {
    lines.emplace_back();
    for (int x = 0; x < grid.width(); ++x) {
      const std::int32_t region = grid.row(y)[x];
      lines.back() += region == RegionGrid::kOccupied  ? '#'
                      : region == RegionGrid::kUnknown ? '?'
                                                       : static_cast<char>('a' + region);
    }
  }
  return lines;
}

using Lines = std::vector<std::string>;

TEST(BitmapRegions, NumbersComponentsInTheOrderOfTheirFirstCells) {
  const RegionGrid grid = labelRegions(bitmapFromArt({".#.?.", ".#.#.", "#.#.#"}), 0, 0);
  EXPECT_EQ(grid.componentCount(), 5);
  EXPECT_EQ(drawn(grid), (Lines{"c#d?e", "c#d#e", "#a#b#"}));
}

TEST(BitmapRegions, JoinsArmsThatMeetLater) {
  const RegionGrid grid = labelRegions(bitmapFromArt({".....", ".#.#.", ".#.#.", "?#?#."}), 0, 0);
  EXPECT_EQ(grid.componentCount(), 1);
  EXPECT_EQ(drawn(grid), (Lines{"aaaaa", "a#a#a", "a#a#a", "?#?#a"}));
}

TEST(BitmapRegions, SmallComponentsBecomeUnknownAndLeaveNoGapInTheNumbers) {
  const RegionGrid grid = labelRegions(bitmapFromArt({"..#..", "##?##", ".#..."}), 2, 0);
  EXPECT_EQ(grid.componentCount(), 3);
  EXPECT_EQ(drawn(grid), (Lines{"bb#cc", "##?##", "?#aaa"}));
}

TEST(BitmapRegions, UnknownRingAroundTheBitmap) {
  const RegionGrid grid = labelRegions(bitmapFromArt({"..", ".."}), 0, 0);
  for (int i = -1; i <= 2; ++i) {
    EXPECT_EQ(grid.row(-1)[i], RegionGrid::kUnknown);
    EXPECT_EQ(grid.row(2)[i], RegionGrid::kUnknown);
    EXPECT_EQ(grid.row(i)[-1], RegionGrid::kUnknown);
    EXPECT_EQ(grid.row(i)[2], RegionGrid::kUnknown);
  }
}

TEST(BitmapRegions, FillsPatchesUpToTheGivenSize) {
  const OccupancyBitmap bitmap = bitmapFromArt({"......", ".?..?.", "..?...", "......"});
  EXPECT_EQ(drawn(labelRegions(bitmap, 0, 1)), (Lines{"aaaaaa", "a?aaaa", "aa?aaa", "aaaaaa"}));
  EXPECT_EQ(drawn(labelRegions(bitmap, 0, 2)), (Lines{"aaaaaa", "aaaaaa", "aaaaaa", "aaaaaa"}));
}

TEST(BitmapRegions, FillsNoPatchAtTheRimOrNextToAnObstacle) {
  const Lines art{"......", ".?#...", "......", "....?.", ".....#", "?....."};
  EXPECT_EQ(drawn(labelRegions(bitmapFromArt(art), 0, 9)),
            (Lines{"aaaaaa", "a?#aaa", "aaaaaa", "aaaa?a", "aaaaa#", "?aaaaa"}));
}

}  // namespace
}  // namespace mrpt_polyloc::test
