#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

/// Maps for tests: small ones with a name, random ones from a seed, and near-degenerate ones.
namespace mrpt_polyloc::test {

/// A ring as a polygon wants it: counterclockwise if outer, else clockwise, all walls.
inline Ring orientedRing(std::vector<TPoint2D> vertices, bool outer) {
  if ((signedArea(vertices) > 0.0) != outer) std::reverse(vertices.begin(), vertices.end());
  return wallRing(std::move(vertices));
}

inline FreePolygon freePolygon(std::vector<TPoint2D> outer,
                               const std::vector<std::vector<TPoint2D>>& holes = {}) {
  FreePolygon polygon{orientedRing(std::move(outer), true), {}};
  for (const auto& hole : holes) polygon.holes.push_back(orientedRing(hole, false));
  return polygon;
}

/// A map of one component.
inline PolygonMap mapOf(std::vector<TPoint2D> outer,
                        const std::vector<std::vector<TPoint2D>>& holes = {}) {
  return PolygonMap({freePolygon(std::move(outer), holes)});
}

inline std::vector<TPoint2D> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// The square [0, side]^2.
inline PolygonMap squareMap(double side = 10.0) {
  return mapOf(rectangle(0, 0, side, side));
}

/// An L of 4 m x 4 m with arms 2 m wide: area 12, one reflex vertex.
inline PolygonMap lRoomMap() {
  return mapOf({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}});
}

/// A room with columns x rows square pillars of 1 m, 2 m apart.
inline PolygonMap pillarMap(int columns = 3, int rows = 2) {
  std::vector<std::vector<TPoint2D>> pillars;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double x = 2.0 + 3.0 * column, y = 2.0 + 3.0 * row;
      pillars.push_back(rectangle(x, y, x + 1.0, y + 1.0));
    }
  }
  return mapOf(rectangle(0, 0, 3.0 * columns + 2.0, 3.0 * rows + 2.0), pillars);
}

/// A corridor with teeth 1 m apart, each 5 m deep and `width` wide.
inline PolygonMap combMap(int teeth = 8, double width = 0.5) {
  std::vector<TPoint2D> v{{0, 0}, {static_cast<double>(teeth), 0}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double x = i + 0.25;
    v.insert(v.end(), {{x + width, 1}, {x + width, 6}, {x, 6}, {x, 1}});
  }
  return mapOf(std::move(v));
}

/// A hall with bent arms, each turning the same way: no arm's end is seen from the middle.
inline PolygonMap windmillMap(int arms = 5) {
  std::vector<TPoint2D> v;
  const double turn = 2.0 * M_PI / arms;
  const auto add = [&](double angle, double radius) {
    v.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int i = 0; i < arms; ++i) {
    const double angle = turn * i;
    add(angle, 2.0);
    add(angle, 5.0);
    add(angle + 0.7 * turn, 5.0);
    add(angle + 0.7 * turn, 4.0);
    add(angle + 0.3 * turn, 4.0);
    add(angle + 0.3 * turn, 2.0);
  }
  return mapOf(std::move(v));
}

/// Holes that touch one another and the outer ring at vertices, and a pair whose vertices lie on
/// the middle of other edges.
inline PolygonMap touchingHolesMap() {
  return mapOf(rectangle(0, 0, 12, 10), {{{0, 5}, {2, 4}, {2, 6}},  // vertex on the outer edge
                                         {{4, 4}, {6, 4}, {6, 6}, {4, 6}},  // corner to corner with
                                         {{6, 6}, {8, 6}, {8, 8}, {6, 8}},  // ... this one
                                         {{8, 7}, {10, 6}, {10, 8}}});      // vertex on its edge
}

/// Walls that meet at angles of a thousandth of a radian, and passages a micrometre wide.
inline PolygonMap sliverMap() {
  return mapOf({{0, 0},
                {10, 0},
                {10, 5},
                {20, 5.01},
                {10, 5.02},
                {10, 9},
                {5.000001, 9},
                {5.000001, 12},
                {5, 12},
                {5, 9},
                {0, 9}});
}

/// Vertices on straight walls, where a wall of a hole ends in the middle of another.
inline PolygonMap tJunctionMap() {
  return mapOf({{0, 0}, {3, 0}, {5, 0}, {10, 0}, {10, 4}, {10, 8}, {7, 8}, {0, 8}, {0, 2}},
               {{{3, 0}, {4, 3}, {2, 3}}, {{5, 4}, {7, 4}, {8, 4}, {8, 6}, {5, 6}, {5, 5}}});
}

/// A map moved by (dx, dy), e.g. to UTM-like coordinates of 1e6.
inline PolygonMap translated(const PolygonMap& map, double dx, double dy) {
  std::vector<FreePolygon> components = map.components();
  std::vector<Polyline> walls = map.wallsBeyond();
  const auto move = [&](std::vector<TPoint2D>& points) {
    for (TPoint2D& p : points) p = {p.x + dx, p.y + dy};
  };
  for (FreePolygon& component : components) {
    move(component.outer.vertices);
    for (Ring& hole : component.holes) move(hole.vertices);
  }
  for (Polyline& wall : walls) move(wall);
  return PolygonMap(std::move(components), std::move(walls));
}

/// A map with about this fraction of its edges made open.
inline PolygonMap withOpenEdges(const PolygonMap& map, double fraction, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<FreePolygon> components = map.components();
  const auto open = [&](Ring& ring) {
    for (EdgeKind& kind : ring.kinds) {
      if (unit(random) < fraction) kind = EdgeKind::open;
    }
  };
  for (FreePolygon& component : components) {
    open(component.outer);
    for (Ring& hole : component.holes) open(hole);
  }
  return PolygonMap(std::move(components), map.wallsBeyond());
}

/// Whether segments ab and cd cross at a point inside both; rounding may err for near misses.
inline bool segmentsCross(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c,
                          const TPoint2D& d) {
  const auto side = [](const TPoint2D& o, const TPoint2D& p, const TPoint2D& q) {
    return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  };
  return (side(a, b, c) > 0) != (side(a, b, d) > 0) && (side(c, d, a) > 0) != (side(c, d, b) > 0);
}

/// A random simple ring through n random points of [0, size]^2: a random tour, its crossings
/// removed one by one (2-opt). For n up to some hundreds.
inline std::vector<TPoint2D> randomSimpleRing(std::size_t n, unsigned seed, double size = 10.0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(0.0, size);
  std::vector<TPoint2D> v(n);
  for (TPoint2D& p : v) p = {coordinate(random), coordinate(random)};
  bool is_changed = true;
  while (is_changed) {  // every step makes the ring shorter
    is_changed = false;
    for (std::size_t i = 0; i + 2 < n; ++i) {
      for (std::size_t j = i + 2; j < n - (i == 0 ? 1 : 0); ++j) {
        if (segmentsCross(v[i], v[i + 1], v[j], v[(j + 1) % n])) {
          std::reverse(v.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       v.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          is_changed = true;
        }
      }
    }
  }
  return v;
}

/// A random simple polygon of n vertices in [0, size]^2.
inline PolygonMap randomSimpleMap(std::size_t n, unsigned seed, double size = 10.0) {
  return mapOf(randomSimpleRing(n, seed, size));
}

/// A random simple polygon with small triangular holes.
inline PolygonMap randomMapWithHoles(std::size_t n, std::size_t holes, unsigned seed,
                                     double size = 10.0) {
  const PolygonMap plain = randomSimpleMap(n, seed, size);
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> coordinate(0.0, size);
  std::vector<std::vector<TPoint2D>> triangles;
  const auto clearance = [&](const TPoint2D& p) {  // to all edges so far
    double least = size;
    const auto look = [&](const std::vector<TPoint2D>& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const TPoint2D a = ring[i], d = ring[(i + 1) % ring.size()] - a;
        const double t =
            std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
        least = std::min(least, std::hypot(p.x - a.x - t * d.x, p.y - a.y - t * d.y));
      }
    };
    look(plain.components()[0].outer.vertices);
    for (const auto& triangle : triangles) look(triangle);
    return least;
  };
  for (std::size_t tries = 0; tries < 100 * holes && triangles.size() < holes; ++tries) {
    const TPoint2D center(coordinate(random), coordinate(random));
    const bool in_hole = std::any_of(triangles.begin(), triangles.end(),
                                     [&](const auto& t) { return mapOf(t).contains(center); });
    const double radius = 0.5 * clearance(center);
    if (!plain.contains(center) || in_hole || radius < 1e-3 * size) continue;
    const double angle = coordinate(random);
    triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      triangles.back().emplace_back(center.x + radius * std::cos(angle + 2.1 * i),
                                    center.y + radius * std::sin(angle + 2.1 * i));
    }
  }
  return mapOf(plain.components()[0].outer.vertices, triangles);
}

/// A hall with columns x rows round pillars of `corners` vertices each, 4 m apart, and a wavy wall:
/// 40 x 40 pillars of 20 corners make 1,600 holes and, with 3,000 wall vertices, 35,000 vertices.
inline PolygonMap largeMap(int columns = 40, int rows = 40, int corners = 20,
                           int wall_vertices = 3000) {
  std::vector<std::vector<TPoint2D>> pillars;
  for (int i = 0; i < columns * rows; ++i) {
    const double x = 4.0 * (i % columns) + 4.0, y = 4.0 * (i / columns) + 4.0;
    std::vector<TPoint2D> pillar;
    for (int k = 0; k < corners; ++k) {
      const double radius = k % 2 == 0 ? 1.0 : 0.7, angle = 2.0 * M_PI * k / corners;
      pillar.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
    }
    pillars.push_back(std::move(pillar));
  }
  const double width = 4.0 * columns + 4.0, height = 4.0 * rows + 4.0;
  std::vector<TPoint2D> wall{{0, 0}, {width, 0}};
  for (int i = 0; i < wall_vertices; ++i) {
    wall.emplace_back(width * (1.0 - (i + 0.5) / wall_vertices), height + (i % 2 == 0 ? 0.0 : 0.5));
  }
  return mapOf(std::move(wall), pillars);
}

/// All of the small maps above, by name.
inline std::vector<std::pair<const char*, PolygonMap>> namedMaps() {
  return {{"square", squareMap()},
          {"L room", lRoomMap()},
          {"pillars", pillarMap()},
          {"comb", combMap()},
          {"windmill", windmillMap()},
          {"touching holes", touchingHolesMap()},
          {"slivers", sliverMap()},
          {"T junctions", tJunctionMap()},
          {"pillars at 1e6", translated(pillarMap(), 1e6, -2e6)},
          {"random", randomSimpleMap(60, 1)},
          {"random with holes", randomMapWithHoles(60, 8, 2)}};
}

}  // namespace mrpt_polyloc::test
