#include <mrpt_polyloc/geometry/room_union.h>

// Boost 1.74 with g++ 12: false alarms of its optimizer, deep in Boost.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <cstddef>
#include <utility>

namespace mrpt_polyloc {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point>;
using Region = bg::model::multi_polygon<Polygon>;

void append(const Ring& ring, bg::model::ring<Point>& out) {
  for (const TPoint2D& p : ring.vertices) out.emplace_back(p.x, p.y);
}

Region regionOf(const RawPolygon& raw) {
  Polygon polygon;
  append(raw.outer, polygon.outer());
  for (const Ring& hole : raw.holes) {
    polygon.inners().emplace_back();
    append(hole, polygon.inners().back());
  }
  bg::correct(polygon);
  return {polygon};
}

Ring ringOf(const bg::model::ring<Point>& ring) {
  std::vector<TPoint2D> vertices;
  for (const Point& p : ring) vertices.emplace_back(p.x(), p.y());
  if (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
  return wallRing(std::move(vertices));
}

}  // namespace

RawMap uniteRooms(const RawMap& raw) {
  std::vector<Region> regions;
  for (const RawPolygon& polygon : raw.polygons) regions.push_back(regionOf(polygon));
  // In pairs, so that no vertex takes part in more unions than there are levels.
  while (regions.size() > 1) {
    std::vector<Region> next((regions.size() + 1) / 2);
    for (std::size_t i = 0; i + 1 < regions.size(); i += 2) {
      bg::union_(regions[i], regions[i + 1], next[i / 2]);
    }
    if (regions.size() % 2 == 1) next.back() = std::move(regions.back());
    regions = std::move(next);
  }
  RawMap united;
  united.walls_beyond = raw.walls_beyond;
  if (regions.empty()) return united;
  for (const Polygon& polygon : regions.front()) {
    RawPolygon out;
    out.outer = ringOf(polygon.outer());
    for (const auto& hole : polygon.inners()) out.holes.push_back(ringOf(hole));
    united.polygons.push_back(std::move(out));
  }
  return united;
}

}  // namespace mrpt_polyloc
