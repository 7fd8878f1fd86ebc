#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/geometry/WallDistances.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

constexpr double kUnit = 1e-4;  // [m]

/// The least cell size of a grid over a box that has at most so many cells as its directory of
/// tiles can take (40 MB).
double cellSizeFor(double width, double height) {
  constexpr double kMostCells = 4e10;
  const double cells = (width / WallDistances::kCellSize) * (height / WallDistances::kCellSize);
  return WallDistances::kCellSize * std::max(1.0, std::sqrt(cells / kMostCells));
}

}  // namespace

WallDistances::WallDistances(const Triangulation& t) : origin_(t.box().min) {
  const double width = t.box().max.x - t.box().min.x, height = t.box().max.y - t.box().min.y;
  cell_size_ = cellSizeFor(width, height);
  grid_ = TiledGrid(static_cast<int>(width / cell_size_) + 2,
                    static_cast<int>(height / cell_size_) + 2);
  for (std::size_t f = 0; f < t.faces().size(); ++f) {
    const Triangulation::Face& face = t.faces()[f];
    for (std::size_t i = 0; i < 3; ++i) {
      // Each edge from one of its sides; on the rim of the box there are no walls.
      if (face.passage[i] != Passage::wall) continue;
      if (face.neighbor[i] < static_cast<std::int32_t>(f)) continue;
      take(t.vertices()[static_cast<std::size_t>(face.vertex[(i + 1) % 3])],
           t.vertices()[static_cast<std::size_t>(face.vertex[(i + 2) % 3])]);
    }
  }
}

/// In pieces, so that the boxes around long slanted walls stay small.
void WallDistances::take(const TPoint2D& a, const TPoint2D& b) {
  constexpr double kPiece = 1.0;  // [m]
  const auto pieces = static_cast<int>((b - a).norm() / kPiece) + 1;
  for (int k = 0; k < pieces; ++k) {
    takePiece(a + (b - a) * (static_cast<double>(k) / pieces),
              a + (b - a) * (static_cast<double>(k + 1) / pieces));
  }
}

void WallDistances::takePiece(const TPoint2D& a, const TPoint2D& b) {
  const auto clamped = [this](double cells, int count) {
    return std::clamp(static_cast<int>(std::floor(cells)), 0, count - 1);
  };
  const auto column = [&](double x) {
    return clamped((x - origin_.x) / cell_size_, grid_.columns());
  };
  const auto row = [&](double y) { return clamped((y - origin_.y) / cell_size_, grid_.rows()); };
  const int last_column = column(std::max(a.x, b.x) + kReach);
  const int last_row = row(std::max(a.y, b.y) + kReach);
  for (int r = row(std::min(a.y, b.y) - kReach); r <= last_row; ++r) {
    for (int c = column(std::min(a.x, b.x) - kReach); c <= last_column; ++c) {
      const TPoint2D corner{origin_.x + c * cell_size_, origin_.y + r * cell_size_};
      const double distance = distanceToSegment(corner, a, b);
      if (distance >= kReach) continue;
      const auto units = static_cast<std::int32_t>(distance / kUnit);
      const std::int32_t before = grid_.at(c, r);
      if (before == TiledGrid::kNone || units < before) grid_.put(c, r, units);
    }
  }
}

double WallDistances::atCorner(int column, int row) const {
  const std::int32_t units = grid_.at(column, row);
  return units == TiledGrid::kNone ? kReach : units * kUnit;
}

double WallDistances::at(double x, double y) const {
  const double u = (x - origin_.x) / cell_size_, v = (y - origin_.y) / cell_size_;
  if (!(u >= 0.0 && v >= 0.0 && u < grid_.columns() - 1 && v < grid_.rows() - 1)) return kReach;
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const double right = u - column, up = v - row;
  const double below = (1.0 - right) * atCorner(column, row) + right * atCorner(column + 1, row);
  const double above =
      (1.0 - right) * atCorner(column, row + 1) + right * atCorner(column + 1, row + 1);
  return (1.0 - up) * below + up * above;
}

}  // namespace mrpt_polyloc
