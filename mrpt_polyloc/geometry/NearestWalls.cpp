#include <mrpt_polyloc/geometry/NearestWalls.h>

#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/segment.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Wall = std::pair<bg::model::segment<Point>, std::uint32_t>;

TPoint2D nearestOn(const TPoint2D& a, const TPoint2D& b, const TPoint2D& p) {
  const TPoint2D edge = b - a, to_p = p - a;
  const double norm = edge.x * edge.x + edge.y * edge.y;
  const double t = norm > 0.0 ? (to_p.x * edge.x + to_p.y * edge.y) / norm : 0.0;
  return a + edge * std::clamp(t, 0.0, 1.0);
}

std::vector<Wall> wallsOf(const PolygonMap& map) {
  std::vector<Wall> walls;
  const auto add = [&](const TPoint2D& a, const TPoint2D& b) {
    walls.push_back({{{a.x, a.y}, {b.x, b.y}}, static_cast<std::uint32_t>(walls.size())});
  };
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] != EdgeKind::wall) continue;
      add(ring->vertices[i], ring->vertices[(i + 1) % ring->size()]);
    }
  }
  for (const Polyline& line : map.wallsBeyond()) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) add(line[i], line[i + 1]);
  }
  return walls;
}

}  // namespace

struct NearestWalls::Tree {
  bg::index::rtree<Wall, bg::index::rstar<16>> walls;
};

NearestWalls::NearestWalls(const PolygonMap& map)
    : tree_(std::make_shared<const Tree>(Tree{decltype(Tree::walls)(wallsOf(map))})) {}

std::optional<NearestWalls::Nearest> NearestWalls::nearest(const TPoint2D& point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
  const auto found = tree_->walls.qbegin(bg::index::nearest(Point(point.x, point.y), 1));
  if (found == tree_->walls.qend()) return std::nullopt;
  const auto& [a, b] = found->first;
  const TPoint2D on_wall = nearestOn({a.x(), a.y()}, {b.x(), b.y()}, point);
  const TPoint2D off = point - on_wall;
  return Nearest{on_wall, off.x * off.x + off.y * off.y, found->second};
}

}  // namespace mrpt_polyloc
