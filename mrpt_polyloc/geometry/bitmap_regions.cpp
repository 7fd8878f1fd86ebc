#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// While labelling, a free cell that has no component yet.
constexpr std::int32_t kFree = 0;
/// While filling, an unknown cell that was looked at.
constexpr std::int32_t kSeenUnknown = -3;

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

using Cell = std::pair<int, int>;

/// Marks the patch of unknown cells around `start` as seen and collects it. Returns whether it
/// touches free cells alone; a patch at the rim touches the unknown cells outside.
bool collectUnknownPatch(RegionGrid& grid, Cell start, std::vector<Cell>& patch) {
  bool only_free = true;
  patch.assign(1, start);
  grid.row(start.second)[start.first] = kSeenUnknown;
  for (std::size_t next = 0; next < patch.size(); ++next) {
    const auto [x, y] = patch[next];
    for (int ny = y - 1; ny <= y + 1; ++ny) {
      for (int nx = x - 1; nx <= x + 1; ++nx) {
        if (nx < 0 || ny < 0 || nx >= grid.width() || ny >= grid.height()) {
          only_free = false;
          continue;
        }
        std::int32_t& neighbor = grid.row(ny)[nx];
        if (neighbor == RegionGrid::kOccupied) only_free = false;
        if (neighbor != RegionGrid::kUnknown) continue;
        neighbor = kSeenUnknown;
        patch.emplace_back(nx, ny);
      }
    }
  }
  return only_free;
}

void fillUnknownPatches(RegionGrid& grid, double max_cells) {
  std::vector<Cell> patch;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (grid.row(y)[x] != RegionGrid::kUnknown) continue;
      const bool fill = collectUnknownPatch(grid, {x, y}, patch) &&
                        static_cast<double>(patch.size()) <= max_cells;
      if (!fill) continue;
      for (const auto& [px, py] : patch) grid.row(py)[px] = kFree;
    }
  }
  for (int y = 0; y < grid.height(); ++y) {
    std::int32_t* const row = grid.row(y);
    std::replace(row, row + grid.width(), kSeenUnknown, RegionGrid::kUnknown);
  }
}

/// Union-find over provisional labels; the root of a set is its smallest label, hence the one of
/// its first cell.
class LabelSets {
 public:
  std::int32_t add() {
    parent_.push_back(static_cast<std::int32_t>(parent_.size()));
    return parent_.back();
  }
  std::int32_t root(std::int32_t label) {
    while (at(label) != label) {
      at(label) = at(at(label));
      label = at(label);
    }
    return label;
  }
  std::int32_t join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a > b) std::swap(a, b);
    at(b) = a;
    return a;
  }
  std::size_t size() const { return parent_.size(); }

 private:
  std::int32_t& at(std::int32_t label) { return parent_[static_cast<std::size_t>(label)]; }

  std::vector<std::int32_t> parent_;
};

LabelSets labelProvisionally(RegionGrid& grid) {
  LabelSets sets;
  for (int y = 0; y < grid.height(); ++y) {
    std::int32_t* const row = grid.row(y);
    const std::int32_t* const below = grid.row(y - 1);
    for (int x = 0; x < grid.width(); ++x) {
      if (row[x] != kFree) continue;
      if (row[x - 1] >= 0) {
        row[x] = row[x - 1];
        if (below[x] >= 0 && below[x] != row[x]) sets.join(below[x], row[x]);
      } else {
        row[x] = below[x] >= 0 ? below[x] : sets.add();
      }
    }
  }
  return sets;
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
  LabelSets sets = labelProvisionally(grid);

  const auto forEachFreeCell = [&grid](auto&& visit) {
    for (int y = 0; y < grid.height(); ++y) {
      std::int32_t* const row = grid.row(y);
      for (int x = 0; x < grid.width(); ++x) {
        if (row[x] >= 0) visit(row[x]);
      }
    }
  };
  std::vector<std::size_t> cell_count(sets.size(), 0);
  forEachFreeCell([&](std::int32_t& cell) { ++cell_count[static_cast<std::size_t>(cell)]; });

  std::vector<std::int32_t> component(sets.size(), RegionGrid::kUnknown);
  for (std::size_t label = sets.size(); label-- > 0;) {
    const auto root = static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(label)));
    if (root != label) cell_count[root] += cell_count[label];
  }
  int count = 0;
  for (std::size_t label = 0; label < sets.size(); ++label) {
    const auto root = static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(label)));
    if (root == label && static_cast<double>(cell_count[label]) >= min_component_cells) {
      component[label] = count++;
    } else if (root != label) {
      component[label] = component[root];
    }
  }
  forEachFreeCell([&](std::int32_t& cell) { cell = component[static_cast<std::size_t>(cell)]; });
  grid.setComponentCount(count);
  return grid;
}

}  // namespace mrpt_polyloc
