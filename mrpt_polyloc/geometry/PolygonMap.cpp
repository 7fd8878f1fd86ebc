#include <mrpt_polyloc/base/Checksum.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

std::string at(const TPoint2D& p) {
  return formatted(" at (%.3f, %.3f)", p.x, p.y);
}

void checkFinite(const std::vector<TPoint2D>& points, const char* what) {
  for (const TPoint2D& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      throw InvalidMapError(std::string("coordinate that is not finite in ") + what + at(p));
    }
  }
}

void checkRing(const Ring& ring, bool outer) {
  const char* what = outer ? "outer ring" : "hole";
  if (ring.size() < 3) {
    throw InvalidMapError(std::string(what) + " with fewer than three vertices" +
                          (ring.size() > 0 ? at(ring.vertices.front()) : ""));
  }
  if (ring.kinds.size() != ring.size()) {
    throw InvalidMapError(std::string(what) + " whose edge kinds do not match its vertices" +
                          at(ring.vertices.front()));
  }
  checkFinite(ring.vertices, what);
  const double area = signedArea(ring.vertices);
  if (!std::isfinite(area)) {
    throw InvalidMapError(std::string(what) + " too large for its area to be a number" +
                          at(ring.vertices.front()));
  }
  if (outer ? area <= 0.0 : area >= 0.0) {
    throw InvalidMapError(std::string(what) + " of zero area or wrong orientation" +
                          at(ring.vertices.front()));
  }
}

/// Calls visit(a, b, kind) for every edge of a ring.
template <class Visitor>
void forEachEdge(const Ring& ring, Visitor&& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    visit(ring.vertices[i], ring.vertices[(i + 1) % ring.size()], ring.kinds[i]);
  }
}

double length(const TPoint2D& a, const TPoint2D& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

template <class T>
void add(const T& value, Fnv& hash) {
  hash.add(&value, sizeof(value));
}

void add(const TPoint2D& p, Fnv& hash) {
  add(p.x + 0.0, hash);  // -0 and 0 are one coordinate
  add(p.y + 0.0, hash);
}

}  // namespace

Ring wallRing(std::vector<TPoint2D> vertices) {
  std::vector<EdgeKind> kinds(vertices.size(), EdgeKind::wall);
  return {std::move(vertices), std::move(kinds)};
}

double signedArea(const std::vector<TPoint2D>& vertices) {
  double twice = 0.0;
  for (std::size_t i = 2; i < vertices.size(); ++i) {
    twice += cross(vertices[0], vertices[i - 1], vertices[i]);
  }
  return 0.5 * twice;
}

PolygonMap::PolygonMap(std::vector<FreePolygon> components, std::vector<Polyline> walls_beyond,
                       double cell_size)
    : components_(std::move(components)),
      walls_beyond_(std::move(walls_beyond)),
      cell_size_(cell_size) {
  if (!(cell_size >= 0.0 && std::isfinite(cell_size))) {
    throw InvalidMapError("cell size: not a length");
  }
  if (components_.empty()) throw InvalidMapError("the map has no free space");
  for (const FreePolygon& component : components_) {
    checkRing(component.outer, true);
    for (const Ring& hole : component.holes) checkRing(hole, false);
  }
  for (const Polyline& wall : walls_beyond_) {
    if (wall.size() < 2) throw InvalidMapError("wall beyond with fewer than two points");
    checkFinite(wall, "wall beyond");
  }

  bounding_box_ = BoundingBox::empty();
  for (const FreePolygon& component : components_) {
    bounding_box_.include(BoundingBox::of(component.outer.vertices));
  }
  for (const Polyline& wall : walls_beyond_) bounding_box_.include(BoundingBox::of(wall));
}

std::vector<const Ring*> PolygonMap::rings() const {
  std::vector<const Ring*> all;
  for (const FreePolygon& component : components_) {
    all.push_back(&component.outer);
    for (const Ring& hole : component.holes) all.push_back(&hole);
  }
  return all;
}

bool PolygonMap::contains(const TPoint2D& point) const {
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return false;
  bool inside = false;  // even-odd over all rings: they do not cross
  for (const Ring* ring : rings()) {
    bool on_border = false;
    forEachEdge(*ring, [&](const TPoint2D& a, const TPoint2D& b, EdgeKind) {
      const double side = cross(a, b, point);
      if (side == 0.0 && BoundingBox::of(std::array{a, b}).contains(point)) on_border = true;
      if ((a.y <= point.y) != (b.y <= point.y)) inside ^= (side > 0.0) == (b.y > a.y);
    });
    if (on_border) return true;
  }
  return inside;
}

std::size_t PolygonMap::vertexCount() const {
  std::size_t count = 0;
  for (const Ring* ring : rings()) count += ring->size();
  return count;
}

std::size_t PolygonMap::reflexVertexCount() const {
  std::size_t count = 0;
  for (const Ring* ring : rings()) {
    const std::size_t n = ring->size();
    for (std::size_t i = 0; i < n; ++i) {
      count += cross(ring->vertices[(i + n - 1) % n], ring->vertices[i],
                     ring->vertices[(i + 1) % n]) < 0.0;
    }
  }
  return count;
}

std::size_t PolygonMap::holeCount() const {
  std::size_t count = 0;
  for (const FreePolygon& component : components_) count += component.holes.size();
  return count;
}

double PolygonMap::area() const {
  double area = 0.0;  // holes are clockwise and count negative
  for (const Ring* ring : rings()) area += signedArea(ring->vertices);
  return area;
}

double PolygonMap::perimeter() const {
  double sum = 0.0;
  for (const Ring* ring : rings()) {
    forEachEdge(*ring,
                [&](const TPoint2D& a, const TPoint2D& b, EdgeKind) { sum += length(a, b); });
  }
  return sum;
}

double PolygonMap::openPerimeter() const {
  double sum = 0.0;
  for (const Ring* ring : rings()) {
    forEachEdge(*ring, [&](const TPoint2D& a, const TPoint2D& b, EdgeKind kind) {
      if (kind == EdgeKind::open) sum += length(a, b);
    });
  }
  return sum;
}

double PolygonMap::wallsBeyondLength() const {
  double sum = 0.0;
  for (const Polyline& wall : walls_beyond_) {
    for (std::size_t i = 1; i < wall.size(); ++i) sum += length(wall[i - 1], wall[i]);
  }
  return sum;
}

std::uint64_t PolygonMap::hash() const {
  Fnv hash;
  add(components_.size(), hash);
  for (const FreePolygon& component : components_) add(component.holes.size(), hash);
  for (const Ring* ring : rings()) {
    add(ring->size(), hash);
    for (const TPoint2D& p : ring->vertices) add(p, hash);
    for (const EdgeKind kind : ring->kinds) add(kind, hash);
  }
  for (const Polyline& wall : walls_beyond_) {
    add(wall.size(), hash);
    for (const TPoint2D& p : wall) add(p, hash);
  }
  return hash.value();
}

}  // namespace mrpt_polyloc
