#include <mrpt_polyloc/geometry/bitmap_regions.h>
#include <mrpt_polyloc/geometry/bitmap_runs.h>

#include <algorithm>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// While labelling, a free cell that has no component yet.
constexpr std::int32_t kFree = 0;
void copyStates(const OccupancyBitmap& bitmap, RegionGrid& grid) {
  const CellState* cell = bitmap.cells.data();
  for (int y = 0; y < grid.height(); ++y) {
    std::int32_t* const row = grid.row(y);
    for (int x = 0; x < grid.width(); ++x, ++cell) {
      if (*cell == CellState::free) row[x] = kFree;
      if (*cell == CellState::occupied) row[x] = RegionGrid::kOccupied;
    }
  }
}

/// Whether a run of unknown cells, and so those of its patch that lie beside it, touches nothing
/// but free cells; at the rim it touches the unknown cells outside.
bool touchesFreeAlone(const RegionGrid& grid, const CellRun& run) {
  if (run.row == 0 || run.row + 1 == grid.height()) return false;
  if (run.begin == 0 || run.end == grid.width()) return false;
  const auto has_occupied = [&run](const std::int32_t* row) {
    return std::find(row + run.begin - 1, row + run.end + 1, RegionGrid::kOccupied) !=
           row + run.end + 1;
  };
  return !has_occupied(grid.row(run.row - 1)) && !has_occupied(grid.row(run.row)) &&
         !has_occupied(grid.row(run.row + 1));
}

void fillUnknownPatches(RegionGrid& grid, double max_cells) {
  const RunComponents patches(grid, RegionGrid::kUnknown, Connectivity::by_sides_and_corners);
  std::vector<char> is_filled;
  for (const std::size_t cells : patches.sizes()) {
    is_filled.push_back(static_cast<double>(cells) <= max_cells ? 1 : 0);
  }
  const std::vector<CellRun>& runs = patches.runs();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    char& filled = is_filled[patches.component(i)];
    if (filled != 0 && !touchesFreeAlone(grid, runs[i])) filled = 0;
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (is_filled[patches.component(i)] == 0) continue;
    std::int32_t* const row = grid.row(runs[i].row);
    std::fill(row + runs[i].begin, row + runs[i].end, kFree);
  }
}

}  // namespace

RegionGrid::RegionGrid(int width, int height)
    : width_(width),
      height_(height),
      cells_((static_cast<std::size_t>(width) + 2) * (static_cast<std::size_t>(height) + 2),
             kUnknown) {}

RegionGrid labelRegions(const OccupancyBitmap& bitmap, double min_component_cells,
                        double max_filled_cells) {
  RegionGrid grid(bitmap.width, bitmap.height);
  copyStates(bitmap, grid);
  if (max_filled_cells >= 1.0) fillUnknownPatches(grid, max_filled_cells);
  const RunComponents free(grid, kFree, Connectivity::by_sides);
  std::vector<std::int32_t> label;
  int count = 0;
  for (const std::size_t cells : free.sizes()) {
    const bool is_kept = static_cast<double>(cells) >= min_component_cells;
    label.push_back(is_kept ? count++ : RegionGrid::kUnknown);
  }
  for (std::size_t i = 0; i < free.runs().size(); ++i) {
    const CellRun& run = free.runs()[i];
    std::int32_t* const row = grid.row(run.row);
    std::fill(row + run.begin, row + run.end, label[free.component(i)]);
  }
  grid.setComponentCount(count);
  return grid;
}

}  // namespace mrpt_polyloc
