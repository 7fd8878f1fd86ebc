#include "rectangle_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

using Corner = std::pair<int, int>;  // column and row of a grid line crossing

// Directions in counterclockwise order: east, north, west, south.
constexpr std::array<Corner, 4> kDirections{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

bool isInside(const std::vector<TPoint2D>& ring, const TPoint2D& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const TPoint2D &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

/// Drops vertices between two edges of one direction and kind.
Ring withoutStraightVertices(const Ring& ring) {
  Ring result;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const TPoint2D &before = ring.vertices[(i + n - 1) % n], &here = ring.vertices[i],
                   &after = ring.vertices[(i + 1) % n];
    const bool straight =
        (before.x == here.x && here.x == after.x) || (before.y == here.y && here.y == after.y);
    if (straight && ring.kinds[(i + n - 1) % n] == ring.kinds[i]) continue;
    result.vertices.push_back(here);
    result.kinds.push_back(ring.kinds[i]);
  }
  return result;
}

}  // namespace

void RectangleCanvas::paint(double x0, double y0, double x1, double y1, Paint paint) {
  rectangles_.push_back({x0, y0, x1, y1, paint});
}

Paint RectangleCanvas::at(const TPoint2D& p) const {
  const auto last = std::find_if(rectangles_.rbegin(), rectangles_.rend(), [&p](const auto& r) {
    return p.x >= r.x0 && p.x < r.x1 && p.y >= r.y0 && p.y < r.y1;
  });
  return last == rectangles_.rend() ? Paint::solid : last->paint;
}

Paint RectangleCanvas::Cells::at(int column, int row) const {
  if (column < 0 || row < 0 || column >= columns() || row >= rows()) return Paint::solid;
  return paints[static_cast<std::size_t>(row * columns() + column)];
}

RectangleCanvas::Cells RectangleCanvas::cells() const {
  Cells cells;
  for (const Rectangle& r : rectangles_) {
    cells.xs.insert(cells.xs.end(), {r.x0, r.x1});
    cells.ys.insert(cells.ys.end(), {r.y0, r.y1});
  }
  for (auto* lines : {&cells.xs, &cells.ys}) {
    std::sort(lines->begin(), lines->end());
    lines->erase(std::unique(lines->begin(), lines->end()), lines->end());
  }
  cells.paints.assign(static_cast<std::size_t>(cells.columns() * cells.rows()), Paint::solid);
  const auto line = [](const std::vector<double>& lines, double value) {
    return static_cast<int>(std::lower_bound(lines.begin(), lines.end(), value) - lines.begin());
  };
  for (const Rectangle& r : rectangles_) {
    for (int row = line(cells.ys, r.y0); row < line(cells.ys, r.y1); ++row) {
      for (int column = line(cells.xs, r.x0); column < line(cells.xs, r.x1); ++column) {
        cells.paints[static_cast<std::size_t>(row * cells.columns() + column)] = r.paint;
      }
    }
  }
  return cells;
}

double RectangleCanvas::freeArea() const {
  const Cells cells = this->cells();
  double area = 0.0;
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      if (cells.at(column, row) != Paint::free) continue;
      const auto c = static_cast<std::size_t>(column), r = static_cast<std::size_t>(row);
      area += (cells.xs[c + 1] - cells.xs[c]) * (cells.ys[r + 1] - cells.ys[r]);
    }
  }
  return area;
}

std::vector<FreePolygon> RectangleCanvas::freeSpace() const {
  const Cells cells = this->cells();
  // Border edges with free space on their left, by start corner and direction.
  std::map<std::pair<Corner, int>, EdgeKind> edges;
  for (int row = 0; row < cells.rows(); ++row) {
    for (int column = 0; column < cells.columns(); ++column) {
      if (cells.at(column, row) != Paint::free) continue;
      const std::array<Corner, 4> starts{
          {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
      for (int side = 0; side < 4; ++side) {
        const Corner& across = kDirections[static_cast<std::size_t>((side + 3) % 4)];
        const Paint beyond = cells.at(column + across.first, row + across.second);
        if (beyond == Paint::free) continue;
        edges[{starts[static_cast<std::size_t>(side)], side}] =
            beyond == Paint::unknown ? EdgeKind::open : EdgeKind::wall;
      }
    }
  }
  std::vector<Ring> outers, holes;
  while (!edges.empty()) {
    Ring ring;
    auto edge = edges.begin();
    while (edge != edges.end()) {
      const auto [corner, direction] = edge->first;
      ring.vertices.emplace_back(cells.xs[static_cast<std::size_t>(corner.first)],
                                 cells.ys[static_cast<std::size_t>(corner.second)]);
      ring.kinds.push_back(edge->second);
      edges.erase(edge);
      const Corner& step = kDirections[static_cast<std::size_t>(direction)];
      const Corner next{corner.first + step.first, corner.second + step.second};
      edge = edges.end();
      for (const int turn : {1, 0, 3}) {  // left first: parts that touch at a corner stay apart
        edge = edges.find({next, (direction + turn) % 4});
        if (edge != edges.end()) break;
      }
    }
    ring = withoutStraightVertices(ring);
    (signedArea(ring.vertices) > 0 ? outers : holes).push_back(std::move(ring));
  }
  std::vector<FreePolygon> polygons;
  for (Ring& ring : outers) addRing(polygons, std::move(ring));
  for (Ring& ring : holes) addRing(polygons, std::move(ring));
  return polygons;
}

void addRing(std::vector<FreePolygon>& polygons, Ring ring) {
  if (signedArea(ring.vertices) > 0) {
    polygons.push_back({std::move(ring), {}});
    return;
  }
  // A point just inside free space, that is left of the first edge, tells whose hole it is.
  const TPoint2D &a = ring.vertices[0], &b = ring.vertices[1];
  const TPoint2D free{0.5 * (a.x + b.x) - 1e-6 * (b.y - a.y),
                      0.5 * (a.y + b.y) + 1e-6 * (b.x - a.x)};
  FreePolygon* owner = nullptr;
  for (FreePolygon& polygon : polygons) {
    if (!isInside(polygon.outer.vertices, free)) continue;
    if (owner == nullptr ||
        signedArea(polygon.outer.vertices) < signedArea(owner->outer.vertices)) {
      owner = &polygon;
    }
  }
  if (owner != nullptr) owner->holes.push_back(std::move(ring));
}

}  // namespace mrpt_polyloc::test
