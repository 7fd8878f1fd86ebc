#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What is known of one cell of an occupancy grid.
enum class CellState : std::uint8_t { unknown, free, occupied };

/// A plain occupancy bitmap: what tracing reads, whatever file it came from.
///
/// Cell (column, row) covers the square [column, column+1] x [row, row+1] in units of
/// `resolution`, in the frame of the bitmap; row 0 is the lowest. `pose_map_bitmap` places the
/// lower left corner of cell (0, 0) and the direction of the rows in the map. Everything outside
/// is unknown.
struct POLYLOC_EXPORT OccupancyBitmap {
  int width = 0;            ///< columns
  int height = 0;           ///< rows
  double resolution = 0.0;  ///< side of a cell [m]
  mrpt::math::TPose2D pose_map_bitmap{0, 0, 0};
  std::vector<CellState> cells;  ///< row by row, `width * height`

  CellState at(int column, int row) const {
    if (column < 0 || row < 0 || column >= width || row >= height) return CellState::unknown;
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)];
  }
};

}  // namespace mrpt_polyloc
