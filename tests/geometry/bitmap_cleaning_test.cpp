#include "tests/support/bitmap_art.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/bitmap_cleaning.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

using ::testing::HasSubstr;
using Lines = std::vector<std::string>;

/// Gaps of so many cells are closed (cells are 1 m wide), ragged rims are left.
BitmapCleaningParams gapsOnly(double max_wall_gap) {
  BitmapCleaningParams params;
  params.max_wall_gap = max_wall_gap;
  params.ragged_passes = 0;
  return params;
}

BitmapCleaningParams raggedOnly(int passes) {
  BitmapCleaningParams params;
  params.max_wall_gap = 0.0;
  params.ragged_passes = passes;
  return params;
}

std::string cleaned(const Lines& art, const BitmapCleaningParams& params) {
  return toArt(cleanBitmap(bitmapFromArt(art), params));
}

std::string joined(const Lines& art) {
  return toArt(bitmapFromArt(art));
}

TEST(BitmapCleaning, ClosesAGapUpToTheGivenWidth) {
  const Lines open{"???????", "#????##", "......."}, closed{"???????", "#######", "......."};
  EXPECT_EQ(cleaned(open, gapsOnly(5.0)), joined(closed));  // the dots are five cells apart
  EXPECT_EQ(cleaned(open, gapsOnly(4.99)), joined(open));
  EXPECT_EQ(cleaned(open, gapsOnly(10.0)), joined(closed));
}

TEST(BitmapCleaning, ClosesGapsInColumnsToo) {
  const Lines open{"?#.", "??.", "??.", "?#."}, closed{"?#.", "?#.", "?#.", "?#."};
  EXPECT_EQ(cleaned(open, gapsOnly(3.0)), joined(closed));
  EXPECT_EQ(cleaned(open, gapsOnly(2.0)), joined(open));
}

TEST(BitmapCleaning, MeasuresTheGapInMetres) {
  OccupancyBitmap bitmap = bitmapFromArt({"#?????#", "......."});  // six cells apart
  bitmap.resolution = 0.05;
  EXPECT_EQ(toArt(cleanBitmap(bitmap, gapsOnly(0.3))), joined({"#######", "......."}));
  EXPECT_EQ(toArt(cleanBitmap(bitmap, gapsOnly(0.29))), toArt(bitmap));
  bitmap.resolution = 0.1;
  EXPECT_EQ(toArt(cleanBitmap(bitmap, gapsOnly(0.3))), toArt(bitmap));
}

TEST(BitmapCleaning, OnlyCellsAtTheRimOfFreeSpaceAreFilled) {
  const Lines art{"#????#", "#????#", "......"};
  EXPECT_EQ(cleaned(art, gapsOnly(5.0)), joined({"#????#", "######", "......"}));
}

TEST(BitmapCleaning, ADoorOfFreeCellsStaysOpen) {
  const Lines art{"##...##", "......."};
  EXPECT_EQ(cleaned(art, gapsOnly(10.0)), joined(art));
}

/// Whether steps to the four neighbours that are not occupied lead from the lowest row to the
/// highest.
bool canBePassed(const OccupancyBitmap& bitmap) {
  std::vector<std::pair<int, int>> open;
  OccupancyBitmap seen = bitmap;
  const auto visit = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= bitmap.width || row >= bitmap.height) return;
    if (seen.at(column, row) == CellState::occupied) return;
    cellAt(seen, column, row) = CellState::occupied;
    open.emplace_back(column, row);
  };
  for (int column = 0; column < bitmap.width; ++column) visit(column, 0);
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    if (row == bitmap.height - 1) return true;
    visit(column - 1, row);
    visit(column + 1, row);
    visit(column, row - 1);
    visit(column, row + 1);
  }
  return false;
}

TEST(BitmapCleaning, JoinsTheDotsOfSlantedWalls) {
  for (const int rise : {0, 1, 2, 3, 4}) {  // over four columns
    OccupancyBitmap bitmap = uniformBitmap(13, 20, CellState::unknown);
    for (int column = 0; column < bitmap.width; ++column) {
      for (int row = 0; 4 * (row + 1) <= 8 + rise * column; ++row) {
        cellAt(bitmap, column, row) = CellState::free;
      }
      if (column % 4 == 0) cellAt(bitmap, column, 2 + rise * column / 4) = CellState::occupied;
    }
    EXPECT_TRUE(canBePassed(bitmap));
    const OccupancyBitmap repaired = cleanBitmap(bitmap, gapsOnly(6.0));
    EXPECT_FALSE(canBePassed(repaired)) << toArt(bitmap) << "\n" << toArt(repaired);
    EXPECT_TRUE(canBePassed(cleanBitmap(bitmap, gapsOnly(3.0))));
  }
}

TEST(BitmapCleaning, OccupiedCellsOnOneSideDoNotClose) {
  const Lines end{"##??", "....", "...."}, corner{"#???", "????", "??#?", "...."};
  EXPECT_EQ(cleaned(end, gapsOnly(3.0)), joined(end));
  EXPECT_EQ(cleaned({"#?#?", "....", "...."}, gapsOnly(2.0)), joined({"###?", "....", "...."}));
  EXPECT_EQ(cleaned(corner, gapsOnly(3.0)), joined(corner));
}

TEST(BitmapCleaning, TakesTheTeethOffARaggedRim) {
  const Lines teeth{"?????", "?.?.?", ".....", "....."};
  // The middle unknown cell has five free neighbours, those at the edge of the picture two or
  // three.
  EXPECT_EQ(cleaned(teeth, raggedOnly(1)), joined({"?????", "?...?", ".....", "....."}));
  EXPECT_EQ(cleaned({"?...?", "..?..", "?...?"}, raggedOnly(1)),
            joined({"?...?", ".....", "?...?"}));
}

TEST(BitmapCleaning, FiveFreeNeighboursAreEnoughFourAreNot) {
  EXPECT_EQ(cleaned({"???", ".?.", "..."}, raggedOnly(1)), joined({"???", "...", "..."}));
  EXPECT_EQ(cleaned({"???", ".?.", "..#"}, raggedOnly(1)), joined({"???", ".?.", "..#"}));
}

TEST(BitmapCleaning, EachPassStartsFromTheLastOnesResult) {
  const Lines notch{".?.", ".?.", ".?.", "..."};
  const Lines once{".?.", "...", "...", "..."};  // the upper end lies at the picture's edge
  EXPECT_EQ(cleaned(notch, raggedOnly(0)), joined(notch));
  EXPECT_EQ(cleaned(notch, raggedOnly(1)), joined(once));
  EXPECT_EQ(cleaned(notch, raggedOnly(2)), joined({"...", "...", "...", "..."}));
}

TEST(BitmapCleaning, NothingIsDoneWhereBothAreOff) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const OccupancyBitmap bitmap = noiseBitmap(30, 20, 0.5, 0.2, seed);
    BitmapCleaningParams none = gapsOnly(0.0);
    EXPECT_EQ(toArt(cleanBitmap(bitmap, none)), toArt(bitmap));
    none.max_wall_gap = 0.99;  // less than a cell
    EXPECT_EQ(toArt(cleanBitmap(bitmap, none)), toArt(bitmap));
  }
}

bool hasFreeNeighbour(const OccupancyBitmap& bitmap, int column, int row) {
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      if (bitmap.at(x, y) == CellState::free) return true;
    }
  }
  return false;
}

/// The rule of the docstring, over all pairs of cells of the bitmap, by points on their lines.
bool liesBetweenWalls(const OccupancyBitmap& bitmap, int column, int row, double gap) {
  std::vector<std::pair<int, int>> walls;
  for (int y = 0; y < bitmap.height; ++y) {
    for (int x = 0; x < bitmap.width; ++x) {
      const bool near = std::hypot(x - column, y - row) <= gap;
      if (near && bitmap.at(x, y) == CellState::occupied) walls.emplace_back(x - column, y - row);
    }
  }
  constexpr int kSteps = 200;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const auto [ax, ay] = walls[i];
      const auto [bx, by] = walls[k];
      if (std::hypot(ax - bx, ay - by) > gap + 1e-9) continue;
      for (int step = 0; step <= kSteps; ++step) {
        const double s = static_cast<double>(step) / kSteps;
        const double x = ax + s * (bx - ax), y = ay + s * (by - ay);
        if (std::max(std::abs(x), std::abs(y)) < 0.5 - 1e-9) return true;
      }
    }
  }
  return false;
}

TEST(BitmapCleaning, OnRandomBitmapsFollowsItsRuleAndKeepsKnownCells) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    const OccupancyBitmap bitmap =
        seed % 2 == 0 ? noiseBitmap(24, 18, 0.3, 0.06, seed) : blobBitmap(24, 18, 12, seed);
    const double gap = 2.0 + seed % 4;
    const OccupancyBitmap repaired = cleanBitmap(bitmap, gapsOnly(gap));
    BitmapCleaningParams both = gapsOnly(gap);
    both.ragged_passes = 2;
    const OccupancyBitmap smooth = cleanBitmap(bitmap, both);
    for (int row = 0; row < bitmap.height; ++row) {
      for (int column = 0; column < bitmap.width; ++column) {
        const CellState before = bitmap.at(column, row);
        const bool fills = before == CellState::unknown && hasFreeNeighbour(bitmap, column, row) &&
                           liesBetweenWalls(bitmap, column, row, gap);
        ASSERT_EQ(repaired.at(column, row), fills ? CellState::occupied : before)
            << column << " " << row << "\n"
            << toArt(bitmap);
        if (repaired.at(column, row) != CellState::unknown) {
          ASSERT_EQ(smooth.at(column, row), repaired.at(column, row));
        } else {
          ASSERT_NE(smooth.at(column, row), CellState::occupied);
        }
      }
    }
  }
}

TEST(BitmapCleaning, KeepsThePlaceAndTakesAnyBitmap) {
  OccupancyBitmap bitmap = bitmapFromArt({"#?#", "..."});
  bitmap.pose_map_bitmap = {3, 4, 0.5};
  const OccupancyBitmap repaired = cleanBitmap(bitmap, gapsOnly(2.0));
  EXPECT_EQ(repaired.pose_map_bitmap, bitmap.pose_map_bitmap);
  EXPECT_EQ(repaired.resolution, 1.0);
  EXPECT_TRUE(cleanBitmap(OccupancyBitmap{}).cells.empty());
  bitmap.cells.pop_back();  // tracing complains, not this
  EXPECT_EQ(cleanBitmap(bitmap, gapsOnly(2.0)).cells, bitmap.cells);
  bitmap = uniformBitmap(3, 3, CellState::unknown);
  for (const double resolution : {0.0, -1.0, std::nan("")}) {
    bitmap.resolution = resolution;
    EXPECT_EQ(cleanBitmap(bitmap).cells, bitmap.cells);
  }
}

TEST(BitmapCleaningParams, ChecksNameTheField) {
  const auto complaint = [](const BitmapCleaningParams& params) -> std::string {
    try {
      cleanBitmap(uniformBitmap(2, 2, CellState::free), params);
    } catch (const InvalidParamsError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint({}), "");
  for (const double bad : {-0.1, 11.0, std::nan("")}) {
    EXPECT_THAT(complaint(gapsOnly(bad)), HasSubstr("max_wall_gap"));
  }
  EXPECT_THAT(complaint(raggedOnly(-1)), HasSubstr("ragged_passes"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
