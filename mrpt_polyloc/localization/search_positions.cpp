#include <mrpt_polyloc/localization/search_positions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mrpt_polyloc {
namespace {

/// Calls visit(row, first, last) for the lattice points in a triangle, row by row.
template <class Visitor>
void scanTriangle(const std::array<TPoint2D, 3>& t, Visitor&& visit) {
  const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
  for (auto row = static_cast<std::int32_t>(std::ceil(low)); row <= high; ++row) {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (std::size_t i = 0; i < 3; ++i) {
      const TPoint2D &a = t[i], &b = t[(i + 1) % 3];
      if (std::min(a.y, b.y) > row || std::max(a.y, b.y) < row) continue;
      const double share = a.y == b.y ? 0.0 : (row - a.y) / (b.y - a.y);
      for (const double x :
           {a.x + share * (b.x - a.x), a.y == b.y ? b.x : a.x + share * (b.x - a.x)}) {
        left = std::min(left, x);
        right = std::max(right, x);
      }
    }
    visit(row, static_cast<std::int32_t>(std::ceil(left)),
          static_cast<std::int32_t>(std::floor(right)));
  }
}

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> searchPositions(
    const Triangulation& triangulation, double spacing) {
  const BoundingBox& box = triangulation.box();
  const auto columns = static_cast<std::int32_t>((box.max.x - box.min.x) / spacing) + 1;
  const auto rows = static_cast<std::int32_t>((box.max.y - box.min.y) / spacing) + 1;
  std::vector<char> is_free(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto at = [columns](std::int32_t column, std::int32_t row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  };
  for (const Triangulation::Face& face : triangulation.faces()) {
    if (!face.is_free) continue;
    std::array<TPoint2D, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const TPoint2D& p = triangulation.vertices()[static_cast<std::size_t>(face.vertex[i])];
      corners[i] = {(p.x - box.min.x) / spacing, (p.y - box.min.y) / spacing};
    }
    scanTriangle(corners, [&](std::int32_t row, std::int32_t first, std::int32_t last) {
      for (std::int32_t column = first; column <= last; ++column) is_free[at(column, row)] = 1;
    });
  }

  std::vector<std::pair<std::int32_t, std::int32_t>> positions;
  for (std::int32_t row = 0; row < rows; ++row) {
    for (std::int32_t column = 0; column < columns; ++column) {
      if (is_free[at(column, row)] != 0) positions.emplace_back(column, row);
    }
  }
  return positions;
}

}  // namespace mrpt_polyloc
