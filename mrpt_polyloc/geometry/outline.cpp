#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/outline.h>

#include <boost/geometry/algorithms/simplify.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/register/linestring.hpp>
#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <cstddef>

BOOST_GEOMETRY_REGISTER_POINT_2D(mrpt::math::TPoint2D, double, boost::geometry::cs::cartesian, x, y)
BOOST_GEOMETRY_REGISTER_LINESTRING(mrpt_polyloc::Polyline)

namespace mrpt_polyloc {
namespace {

bool fitsInto(const std::vector<TPoint2D>& points, double side) {
  const auto by_x = [](const TPoint2D& a, const TPoint2D& b) { return a.x < b.x; };
  const auto by_y = [](const TPoint2D& a, const TPoint2D& b) { return a.y < b.y; };
  const auto [left, right] = std::minmax_element(points.begin(), points.end(), by_x);
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), by_y);
  return right->x - left->x < side && high->y - low->y < side;
}

Polyline simplified(const Polyline& chain, double tolerance) {
  if (tolerance == 0.0 || chain.size() < 3) return chain;
  Polyline result;
  boost::geometry::simplify(chain, result, tolerance);
  return result;
}

/// The vertex where a chain of one kind begins; the first one of a ring of a single kind.
std::size_t chainBegin(const Ring& ring) {
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (ring.kinds[i] != ring.kinds[i - 1]) return i;
  }
  return 0;
}

void addRing(const Ring& ring, double tolerance, MapOutline& outline) {
  if (fitsInto(ring.vertices, tolerance)) return;
  const std::size_t n = ring.size(), begin = chainBegin(ring);
  Polyline closed;
  for (std::size_t done = 0; done < n;) {
    const EdgeKind kind = ring.kinds[(begin + done) % n];
    Polyline chain = {ring.vertices[(begin + done) % n]};
    while (done < n && ring.kinds[(begin + done) % n] == kind) {
      chain.push_back(ring.vertices[(begin + ++done) % n]);
    }
    chain = simplified(chain, tolerance);
    closed.insert(closed.end(), chain.begin() + (closed.empty() ? 0 : 1), chain.end());
    (kind == EdgeKind::wall ? outline.walls : outline.open).push_back(std::move(chain));
  }
  outline.free.push_back(std::move(closed));
}

}  // namespace

MapOutline outlineOf(const PolygonMap& map, double tolerance) {
  requireNotNegative("tolerance", tolerance);
  MapOutline outline;
  for (const Ring* ring : map.rings()) addRing(*ring, tolerance, outline);
  for (const Polyline& wall : map.wallsBeyond()) {
    if (!fitsInto(wall, tolerance)) outline.beyond.push_back(simplified(wall, tolerance));
  }
  return outline;
}

}  // namespace mrpt_polyloc
