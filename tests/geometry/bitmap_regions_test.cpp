#include "tests/support/bitmap_art.h"
#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

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

/// The cells around `start` of one state, by a flood over sides, or sides and corners.
std::vector<std::pair<int, int>> flooded(const OccupancyBitmap& bitmap, int column, int row,
                                         bool by_corners, std::vector<char>& is_seen) {
  const CellState state = bitmap.at(column, row);
  std::vector<std::pair<int, int>> patch;
  const auto visit = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= bitmap.width || y >= bitmap.height) return;
    char& seen = is_seen[static_cast<std::size_t>(y * bitmap.width + x)];
    if (seen != 0 || bitmap.at(x, y) != state) return;
    seen = 1;
    patch.emplace_back(x, y);
  };
  visit(column, row);
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const auto [x, y] = patch[i];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (by_corners || dx == 0 || dy == 0) visit(x + dx, y + dy);
      }
    }
  }
  return patch;
}

bool touchesFreeAlone(const OccupancyBitmap& bitmap, const std::pair<int, int>& cell) {
  const auto [x, y] = cell;
  if (x == 0 || y == 0 || x + 1 == bitmap.width || y + 1 == bitmap.height) return false;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (bitmap.at(x + dx, y + dy) == CellState::occupied) return false;
    }
  }
  return true;
}

template <class Visit>
void forEachPatch(const OccupancyBitmap& bitmap, CellState state, bool by_corners, Visit&& visit) {
  std::vector<char> is_seen(bitmap.cells.size(), 0);
  for (int y = 0; y < bitmap.height; ++y) {
    for (int x = 0; x < bitmap.width; ++x) {
      if (bitmap.at(x, y) != state || is_seen[static_cast<std::size_t>(y * bitmap.width + x)] != 0)
        continue;
      visit(flooded(bitmap, x, y, by_corners, is_seen));
    }
  }
}

TEST(BitmapRegions, AreThoseOfFloods) {
  std::size_t filled = 0, dropped = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const int width = 1 + static_cast<int>(seed % 23), height = 1 + static_cast<int>(seed * 7 % 19);
    const double free_share = 0.4 + 0.1 * (seed % 6);
    const OccupancyBitmap bitmap = noiseBitmap(width, height, free_share, 0.04, seed);
    const std::size_t least = seed % 5, most = seed % 4;
    OccupancyBitmap expected = bitmap;
    forEachPatch(bitmap, CellState::unknown, true, [&](const auto& patch) {
      const bool is_filled =
          patch.size() <= most && std::all_of(patch.begin(), patch.end(), [&](const auto& cell) {
            return touchesFreeAlone(bitmap, cell);
          });
      filled += is_filled;
      for (const auto& [x, y] : patch) {
        if (is_filled) cellAt(expected, x, y) = CellState::free;
      }
    });
    std::vector<std::int32_t> regions;
    for (const CellState state : expected.cells) {
      regions.push_back(state == CellState::occupied ? RegionGrid::kOccupied
                                                     : RegionGrid::kUnknown);
    }
    std::int32_t count = 0;
    forEachPatch(expected, CellState::free, false, [&](const auto& patch) {
      const std::int32_t region = patch.size() >= least ? count++ : RegionGrid::kUnknown;
      dropped += region == RegionGrid::kUnknown;
      for (const auto& [x, y] : patch) regions[static_cast<std::size_t>(y * width + x)] = region;
    });
    const RegionGrid grid =
        labelRegions(bitmap, static_cast<double>(least), static_cast<double>(most));
    EXPECT_EQ(grid.componentCount(), count);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        ASSERT_EQ(grid.row(y)[x], regions[static_cast<std::size_t>(y * width + x)])
            << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(filled, 50U);
  EXPECT_GT(dropped, 50U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
