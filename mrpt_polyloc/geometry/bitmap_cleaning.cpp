#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/bitmap_cleaning.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// A cell relative to another one.
struct Offset {
  int x, y;
};

/// Whether the line from the centre of one cell to that of another passes through the cell at the
/// origin, which is neither of them.
bool liesBetween(const Offset& a, const Offset& b) {
  const int dot = a.x * b.x + a.y * b.y;
  const int cross = a.x * b.y - a.y * b.x;
  return dot < 0 && 2 * std::abs(cross) < std::abs(a.x - b.x) + std::abs(a.y - b.y);
}

/// Whether a cell lies on the line between two occupied ones at most `gap` cells apart.
bool bridgesGap(const OccupancyBitmap& bitmap, int column, int row, int gap) {
  std::vector<Offset> occupied;
  for (int y = 1 - gap; y < gap; ++y) {
    for (int x = 1 - gap; x < gap; ++x) {
      if (bitmap.at(column + x, row + y) == CellState::occupied) occupied.push_back({x, y});
    }
  }
  for (std::size_t i = 1; i < occupied.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Offset &a = occupied[i], &b = occupied[k];
      const int dx = a.x - b.x, dy = a.y - b.y;
      if (dx * dx + dy * dy <= gap * gap && liesBetween(a, b)) return true;
    }
  }
  return false;
}

/// How many cells of a row, and of those below and above it, are free, by column + 1; outside none.
void countFree(const OccupancyBitmap& bitmap, int row, std::vector<std::uint8_t>& columns) {
  const auto width = static_cast<std::size_t>(bitmap.width);
  columns.assign(width + 2, 0);
  std::uint8_t* __restrict__ const counts = columns.data() + 1;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, bitmap.height - 1); ++y) {
    const CellState* __restrict__ const cells = &bitmap.cells[static_cast<std::size_t>(y) * width];
    for (std::size_t x = 0; x < width; ++x) {
      counts[x] = static_cast<std::uint8_t>(counts[x] + (cells[x] == CellState::free ? 1 : 0));
    }
  }
}

/// Gives every unknown cell with a free neighbour for which the test holds a new state. All tests
/// come before the first change.
template <class Test>
void changeRim(OccupancyBitmap& bitmap, CellState state, Test&& test) {
  const auto width = static_cast<std::size_t>(bitmap.width);
  std::vector<std::size_t> changed;
  std::vector<std::uint8_t> free;
  for (int row = 0; row < bitmap.height; ++row) {
    countFree(bitmap, row, free);
    const std::size_t first = static_cast<std::size_t>(row) * width;
    for (std::size_t column = 0; column < width; ++column) {
      const int free_neighbours = free[column] + free[column + 1] + free[column + 2];
      if (free_neighbours == 0 || bitmap.cells[first + column] != CellState::unknown) continue;
      if (test(static_cast<int>(column), row, free_neighbours)) changed.push_back(first + column);
    }
  }
  for (const std::size_t cell : changed) bitmap.cells[cell] = state;
}

}  // namespace

void BitmapCleaningParams::check() const {
  requireInRange("max_wall_gap", max_wall_gap, 0.0, 10.0);
  requireInRange("ragged_passes", ragged_passes, 0.0, 100.0);
}

OccupancyBitmap cleanBitmap(OccupancyBitmap bitmap, const BitmapCleaningParams& params) {
  params.check();
  const bool has_all_cells = bitmap.width >= 0 && bitmap.height >= 0 &&
                             bitmap.cells.size() == static_cast<std::size_t>(bitmap.width) *
                                                        static_cast<std::size_t>(bitmap.height);
  if (!(bitmap.resolution > 0.0) || !has_all_cells) return bitmap;  // tracing will say so
  constexpr int kWidestGap = 64;      // in cells: bounds the work on fine grids
  constexpr double kRounding = 1e-9;  // 0.3 m are 6 cells of 0.05 m
  const int gap = static_cast<int>(std::min(params.max_wall_gap / bitmap.resolution + kRounding,
                                            static_cast<double>(kWidestGap)));
  if (gap > 1) {
    changeRim(bitmap, CellState::occupied,
              [&](int column, int row, int) { return bridgesGap(bitmap, column, row, gap); });
  }
  constexpr int kMostNeighbours = 5;
  for (int pass = 0; pass < params.ragged_passes; ++pass) {
    changeRim(bitmap, CellState::free,
              [](int, int, int free_neighbours) { return free_neighbours >= kMostNeighbours; });
  }
  return bitmap;
}

}  // namespace mrpt_polyloc
