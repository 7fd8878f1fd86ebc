#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <cstddef>

namespace mrpt_polyloc {
namespace {

/// Where the ray from p through `limit` meets the line a b.
TPoint2D hit(const TPoint2D& p, const TPoint2D& limit, const TPoint2D& a, const TPoint2D& b) {
  const double ux = limit.x - p.x, uy = limit.y - p.y;
  const double ex = b.x - a.x, ey = b.y - a.y;
  const double s = ((a.x - p.x) * uy - (a.y - p.y) * ux) / (ux * ey - uy * ex);
  return {a.x + s * ex, a.y + s * ey};
}

bool same(const TPoint2D& a, const TPoint2D& b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

std::vector<TPoint2D> visibilityPolygon(const Triangulation& triangulation, const View& view) {
  std::vector<TPoint2D> polygon;
  const auto add = [&polygon](const TPoint2D& p) {
    if (polygon.empty() || !same(polygon.back(), p)) polygon.push_back(p);
  };
  const auto at = [&triangulation](std::int32_t v) -> const TPoint2D& {
    return triangulation.vertices()[static_cast<std::size_t>(v)];
  };
  for (const VisibleEdge& piece : view.ends) {
    const TPoint2D &a = at(piece.right), &b = at(piece.left);
    add(piece.right == piece.right_limit ? a : hit(view.viewpoint, at(piece.right_limit), a, b));
    add(piece.left == piece.left_limit ? b : hit(view.viewpoint, at(piece.left_limit), a, b));
  }
  while (polygon.size() > 1 && same(polygon.front(), polygon.back())) polygon.pop_back();
  return polygon;
}

}  // namespace mrpt_polyloc
