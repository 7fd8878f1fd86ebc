#include <mrpt_polyloc/geometry/bitmap_runs.h>

#include <algorithm>

namespace mrpt_polyloc {

RunComponents::RunComponents(const RegionGrid& grid, std::int32_t value,
                             Connectivity connectivity) {
  const int reach = connectivity == Connectivity::by_sides ? 0 : 1;
  std::size_t below = 0;
  for (int row = 0; row < grid.height(); ++row) {
    const std::size_t here = runs_.size();
    takeRow(grid.row(row), row, grid.width(), value);
    joinRows(below, here, reach);
    below = here;
  }
  number();
}

void RunComponents::takeRow(const std::int32_t* cells, int row, int width, std::int32_t value) {
  const auto is_other = [value](std::int32_t cell) { return cell != value; };
  const std::int32_t* const end = cells + width;
  for (const std::int32_t* first = std::find(cells, end, value); first != end;) {
    const std::int32_t* const last = std::find_if(first, end, is_other);
    component_.push_back(static_cast<std::uint32_t>(runs_.size()));
    runs_.push_back({row, static_cast<int>(first - cells), static_cast<int>(last - cells)});
    first = std::find(last, end, value);
  }
}

/// Joins the runs from `here` on to those of the row below that lie beside them, or with a reach of
/// 1 touch their corners.
void RunComponents::joinRows(std::size_t below, std::size_t here, int reach) {
  std::size_t i = below, k = here;
  while (i < here && k < runs_.size()) {
    const CellRun &a = runs_[i], &b = runs_[k];
    if (a.begin < b.end + reach && b.begin < a.end + reach) {
      const auto [least, other] =
          std::minmax({root(static_cast<std::uint32_t>(i)), root(static_cast<std::uint32_t>(k))});
      component_[other] = least;
    }
    a.end < b.end ? ++i : ++k;
  }
}

/// The first run of a component, as far as they are joined.
std::uint32_t RunComponents::root(std::uint32_t run) {
  while (component_[run] != run) {
    component_[run] = component_[component_[run]];
    run = component_[run];
  }
  return run;
}

void RunComponents::number() {
  // A run refers to one before it, which has its number already.
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const std::uint32_t to = component_[run];
    const bool is_first = to == run;
    component_[run] = is_first ? static_cast<std::uint32_t>(sizes_.size()) : component_[to];
    if (is_first) sizes_.push_back(0);
    sizes_[component_[run]] += runs_[run].cells();
  }
}

}  // namespace mrpt_polyloc
