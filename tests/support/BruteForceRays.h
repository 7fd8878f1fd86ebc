#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <cmath>
#include <limits>
#include <vector>

namespace mrpt_polyloc::test {

/// What one ray meets in a map [m], infinity for nothing.
struct RayHit {
  double wall = std::numeric_limits<double>::infinity();
  double open = std::numeric_limits<double>::infinity();
};

/// Casts rays against every edge of a map, in double, with nothing shared with the library but the
/// map: the oracle for ranges. Edges count with both of their ends; an open edge counts only where
/// the ray crosses it from its left, free, side to its right, and before the first wall.
class BruteForceRays {
 public:
  /// \param horizon walls farther than this behind the open edge are not met [m]
  explicit BruteForceRays(const PolygonMap& map, double horizon = 20.0) : horizon_(horizon) {
    for (const Ring* ring : map.rings()) {
      for (std::size_t i = 0; i < ring->size(); ++i) {
        const Edge edge{ring->vertices[i], ring->vertices[(i + 1) % ring->size()]};
        (ring->kinds[i] == EdgeKind::wall ? walls_ : open_).push_back(edge);
      }
    }
    for (const Polyline& wall : map.wallsBeyond()) {
      for (std::size_t i = 1; i < wall.size(); ++i) walls_.push_back({wall[i - 1], wall[i]});
    }
  }

  RayHit cast(const TPoint2D& from, double angle) const {
    const double ux = std::cos(angle), uy = std::sin(angle);
    RayHit hit;
    for (const Edge& edge : walls_) hit.wall = std::fmin(hit.wall, range(edge, from, ux, uy));
    for (const Edge& edge : open_) {
      const bool outwards = (edge.b.x - edge.a.x) * uy - (edge.b.y - edge.a.y) * ux < 0;
      if (outwards) hit.open = std::fmin(hit.open, range(edge, from, ux, uy));
    }
    if (hit.open >= hit.wall) hit.open = std::numeric_limits<double>::infinity();
    if (hit.wall > hit.open + horizon_) hit.wall = std::numeric_limits<double>::infinity();
    return hit;
  }

 private:
  struct Edge {
    TPoint2D a, b;
  };

  static double range(const Edge& edge, const TPoint2D& from, double ux, double uy) {
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    const double ax = edge.a.x - from.x, ay = edge.a.y - from.y;
    const double bx = edge.b.x - from.x, by = edge.b.y - from.y;
    const double side_a = ux * ay - uy * ax, side_b = ux * by - uy * bx;
    if ((side_a > 0 && side_b > 0) || (side_a < 0 && side_b < 0)) return kNothing;
    const double turn = side_b - side_a;
    if (turn == 0) return kNothing;  // along the ray: its ends belong to other edges as well
    const double r = (ax * by - ay * bx) / turn;
    return r > 0 ? r : kNothing;
  }

  double horizon_;
  std::vector<Edge> walls_, open_;
};

}  // namespace mrpt_polyloc::test
