#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A bitmap as tracing sees it: every cell belongs to a free component (numbered from 0), to the
/// occupied or to the unknown cells. One ring of unknown cells surrounds the bitmap.
class RegionGrid {
 public:
  static constexpr std::int32_t kUnknown = -1;
  static constexpr std::int32_t kOccupied = -2;

  RegionGrid(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  int componentCount() const { return component_count_; }
  void setComponentCount(int count) { component_count_ = count; }

  /// Cells of one row, valid from column -1 to column width(); row from -1 to height().
  const std::int32_t* row(int row) const { return cells_.data() + offset(row); }
  std::int32_t* row(int row) { return cells_.data() + offset(row); }

 private:
  std::size_t offset(int row) const {
    return static_cast<std::size_t>(row + 1) * (static_cast<std::size_t>(width_) + 2) + 1;
  }

  int width_;
  int height_;
  int component_count_ = 0;
  std::vector<std::int32_t> cells_;
};

/// Numbers the components of free cells connected by their sides, in the order of their first cell
/// (row by row). Components of fewer than `min_component_cells` become unknown; patches of at most
/// `max_filled_cells` unknown cells, connected by sides or corners, that touch nothing but free
/// cells become free first.
RegionGrid labelRegions(const OccupancyBitmap& bitmap, double min_component_cells,
                        double max_filled_cells);

}  // namespace mrpt_polyloc
