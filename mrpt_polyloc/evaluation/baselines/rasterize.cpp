#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

constexpr int kMargin = 2;            // cells
constexpr double kMostCells = 400e6;  // as for maps that are read

/// Fills by the even-odd rule at the middles of the cells of one row.
void fillRow(const PolygonMap& map, OccupancyBitmap& bitmap, int row) {
  const double y = bitmap.pose_map_bitmap.y + (static_cast<double>(row) + 0.5) * bitmap.resolution;
  std::vector<double> crossings;
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const TPoint2D &a = ring->vertices[i], &b = ring->vertices[(i + 1) % ring->size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const auto column = [&](double x) {
      return static_cast<int>(std::ceil((x - bitmap.pose_map_bitmap.x) / bitmap.resolution - 0.5));
    };
    const int end = std::min(column(crossings[k + 1]), bitmap.width);
    for (int c = std::max(0, column(crossings[k])); c < end; ++c) {
      bitmap.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(bitmap.width) +
                   static_cast<std::size_t>(c)] = CellState::free;
    }
  }
}

void drawWall(OccupancyBitmap& bitmap, const TPoint2D& a, const TPoint2D& b) {
  // Points a quarter of a cell apart: no cell that matters is missed.
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int steps = 1 + static_cast<int>(length / (0.25 * bitmap.resolution));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const auto cell = [&](double from, double to, double corner) {
      return static_cast<int>(std::floor((from + t * (to - from) - corner) / bitmap.resolution));
    };
    const int column = cell(a.x, b.x, bitmap.pose_map_bitmap.x);
    const int row = cell(a.y, b.y, bitmap.pose_map_bitmap.y);
    if (column < 0 || row < 0 || column >= bitmap.width || row >= bitmap.height) continue;
    bitmap.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(bitmap.width) +
                 static_cast<std::size_t>(column)] = CellState::occupied;
  }
}

}  // namespace

OccupancyBitmap rasterize(const PolygonMap& map, double cell) {
  requirePositive("cell", cell);
  const BoundingBox& box = map.boundingBox();
  const double columns = std::ceil((box.max.x - box.min.x) / cell) + 2.0 * kMargin;
  const double rows = std::ceil((box.max.y - box.min.y) / cell) + 2.0 * kMargin;
  if (columns * rows > kMostCells) {
    throw InvalidParamsError("cell: " + std::to_string(cell) + " m makes too many cells");
  }
  OccupancyBitmap bitmap;
  bitmap.width = static_cast<int>(columns);
  bitmap.height = static_cast<int>(rows);
  bitmap.resolution = cell;
  bitmap.pose_map_bitmap = {box.min.x - kMargin * cell, box.min.y - kMargin * cell, 0.0};
  bitmap.cells.assign(static_cast<std::size_t>(columns * rows), CellState::unknown);
  for (int row = 0; row < bitmap.height; ++row) fillRow(map, bitmap, row);
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] == EdgeKind::open) continue;
      drawWall(bitmap, ring->vertices[i], ring->vertices[(i + 1) % ring->size()]);
    }
  }
  for (const Polyline& wall : map.wallsBeyond()) {
    for (std::size_t i = 1; i < wall.size(); ++i) drawWall(bitmap, wall[i - 1], wall[i]);
  }
  return bitmap;
}

}  // namespace mrpt_polyloc
