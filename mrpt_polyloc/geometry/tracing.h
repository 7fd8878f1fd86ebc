#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

namespace mrpt_polyloc {

/// How a bitmap becomes a polygon map.
struct TracingParams {
  /// Greatest distance between the exact cell border and the simplified one, in cells. One cell:
  /// within the resolution of the grid, and it takes the staircase off slanted walls.
  double tolerance_cells = 1.0;
  /// Free components below this area [m2] are dropped: specks of free space seen through windows
  /// cannot hold a robot.
  double min_component_area = 0.25;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Traces free space into polygons: borders between free and occupied cells become wall edges,
/// borders between free and unknown cells (and the rim of the bitmap) open edges; borders between
/// occupied and unknown cells become walls beyond. Occupied specks are kept, however small.
///
/// The border follows the cell sides exactly and is then simplified without changing its topology.
/// \throws InvalidMapError if no free component is left.
PolygonMap traceBitmap(const OccupancyBitmap& bitmap, const TracingParams& params = {});

}  // namespace mrpt_polyloc
