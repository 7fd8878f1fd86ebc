#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

namespace mrpt_polyloc {

/// What is repaired in a measured bitmap before it is traced. The reasons were found on grids made
/// from laser scans, where each far wall is a row of dots, and free space ends in the rays of the
/// scans.
struct POLYLOC_EXPORT BitmapCleaningParams {
  /// Unknown cells at the rim of free space through which the line between two occupied cells at
  /// most this far apart passes become occupied [m]: the dots of a wall are joined, a door (0.7 m)
  /// is not closed.
  /// Without it beams leave through the wall between two dots. 0: none.
  double max_wall_gap = 0.3;
  /// So many times, unknown cells with at least five free ones among their eight neighbours become
  /// free: takes the teeth off ragged rims, which else are most of a map's open edges.
  int ragged_passes = 2;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The repaired bitmap. Cells known to be free or occupied keep their state. O(cells + rim cells
/// times the square of the occupied cells within max_wall_gap of each).
POLYLOC_EXPORT OccupancyBitmap cleanBitmap(OccupancyBitmap bitmap,
                                           const BitmapCleaningParams& params = {});

}  // namespace mrpt_polyloc
