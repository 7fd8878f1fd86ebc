#include "safe_set_outline.h"

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/outline.h>
#include <mrpt_polyloc/geometry/tracing.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc::apps {

std::vector<Polyline> safeSetOutline(const SafeSet& safe, double square) {
  if (safe.reached().empty()) return {};
  constexpr double kFar = std::numeric_limits<double>::infinity();
  TPoint2D low(kFar, kFar), high(-kFar, -kFar);
  for (const SafeSet::Place& place : safe.reached()) {
    low = {std::min(low.x, place.point.x), std::min(low.y, place.point.y)};
    high = {std::max(high.x, place.point.x), std::max(high.y, place.point.y)};
  }
  OccupancyBitmap bitmap;
  bitmap.resolution = square;
  bitmap.pose_map_bitmap = {low.x - 0.5 * square, low.y - 0.5 * square, 0.0};
  bitmap.width = static_cast<int>(std::lround((high.x - low.x) / square)) + 1;
  bitmap.height = static_cast<int>(std::lround((high.y - low.y) / square)) + 1;
  const auto columns = static_cast<std::size_t>(bitmap.width);
  bitmap.cells.assign(columns * static_cast<std::size_t>(bitmap.height), CellState::unknown);
  for (const SafeSet::Place& place : safe.reached()) {
    const auto column = static_cast<std::size_t>(std::lround((place.point.x - low.x) / square));
    const auto row = static_cast<std::size_t>(std::lround((place.point.y - low.y) / square));
    bitmap.cells[row * columns + column] = CellState::free;
  }
  TracingParams exact;
  exact.tolerance_cells = 0.0;
  exact.min_component_area = 0.0;
  return outlineOf(traceBitmap(bitmap, exact), 0.0).free;
}

}  // namespace mrpt_polyloc::apps
