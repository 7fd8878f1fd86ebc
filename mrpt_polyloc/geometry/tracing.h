#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

namespace mrpt_polyloc {

/// How a bitmap becomes a polygon map.
struct POLYLOC_EXPORT TracingParams {
  /// Greatest distance between the exact cell border and the simplified one, in cells. One cell:
  /// within the resolution of the grid, and it takes the staircase off slanted walls. 0 keeps every
  /// corner. Closed borders narrower than two cells times this are simplified less, so that specks
  /// keep their size.
  double tolerance_cells = 1.0;
  /// Free components below this area [m2] are dropped: specks of free space seen through windows
  /// cannot hold a robot. They count as unknown then.
  double min_component_area = 0.25;
  /// Patches of unknown cells (connected by sides or corners) up to this area [m2] that touch
  /// nothing but free cells count as free. 0, the default, leaves all of them unknown: what no
  /// sensor has seen may also be an obstacle.
  double max_filled_unknown_area = 0.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Traces free space into polygons: borders between free and occupied cells become wall edges,
/// borders between free and unknown cells (and the rim of the bitmap) open edges; borders between
/// occupied and unknown cells become walls beyond. Occupied specks are kept, however small.
///
/// Free cells are connected by their sides: a gap between two obstacles that touch at a corner is
/// closed. Rings that touch share a vertex; no ring visits a vertex twice.
///
/// The border follows the cell sides exactly and is then simplified; its vertices are corners of
/// cells and midpoints of their sides. Straight axis-parallel walls stay exact, slanted ones run
/// through the middle of their staircase. The topology stays: rings and walls beyond never cross,
/// no ring vanishes, and vertices where wall, open and beyond meet are kept. All choices are made
/// in a fixed order: one bitmap, one map. Takes time linear in the number of cells and n log n in
/// the number n of border corners (23 million cells with 800,000 corners: about a second and 300
/// MB). \throws InvalidMapError if the bitmap is malformed or no free component is left. \throws
/// InvalidParamsError naming the bad field of `params`.
POLYLOC_EXPORT PolygonMap traceBitmap(const OccupancyBitmap& bitmap,
                                      const TracingParams& params = {});

}  // namespace mrpt_polyloc
