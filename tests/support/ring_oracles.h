#pragma once

#include <mrpt_polyloc/geometry/validation.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Brute-force answers about rings, to check the library against.
namespace mrpt_polyloc::test {

/// How many times a ring winds around a point, by summing angles; the point must be off the ring.
inline int windingNumber(const std::vector<TPoint2D>& ring, const TPoint2D& p) {
  double angle = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const TPoint2D a = ring[i] - p, b = ring[(i + 1) % ring.size()] - p;
    angle += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return static_cast<int>(std::lround(angle / (2.0 * M_PI)));
}

/// How two segments meet, exactly.
enum class Meeting { none, touch, cross, overlap };

inline Meeting meetingOf(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c,
                         const TPoint2D& d) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  const Point pa(a.x, a.y), pb(b.x, b.y), pc(c.x, c.y), pd(d.x, d.y);
  const int sc = CGAL::orientation(pa, pb, pc), sd = CGAL::orientation(pa, pb, pd);
  const int sa = CGAL::orientation(pc, pd, pa), sb = CGAL::orientation(pc, pd, pb);
  if (sa == 0 && sb == 0 && sc == 0 && sd == 0) {
    const Point low = std::max(std::min(pa, pb), std::min(pc, pd));
    const Point high = std::min(std::max(pa, pb), std::max(pc, pd));
    return low < high ? Meeting::overlap : low == high ? Meeting::touch : Meeting::none;
  }
  if (sc * sd > 0 || sa * sb > 0) return Meeting::none;
  return sc * sd < 0 && sa * sb < 0 ? Meeting::cross : Meeting::touch;
}

/// Edges of all rings of a map.
struct OracleEdge {
  TPoint2D a, b;
  EdgeKind kind;
};

inline void appendEdges(const Ring& ring, std::vector<OracleEdge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    edges.push_back({ring.vertices[i], ring.vertices[(i + 1) % ring.size()], ring.kinds[i]});
  }
}

inline std::vector<OracleEdge> edgesOf(const PolygonMap& map) {
  std::vector<OracleEdge> edges;
  for (const Ring* ring : map.rings()) appendEdges(*ring, edges);
  return edges;
}

inline std::vector<OracleEdge> edgesOf(const RawMap& map) {
  std::vector<OracleEdge> edges;
  for (const RawPolygon& polygon : map.polygons) {
    appendEdges(polygon.outer, edges);
    for (const Ring& hole : polygon.holes) appendEdges(hole, edges);
  }
  return edges;
}

/// How many pairs of edges meet in this way.
inline std::size_t countMeetings(const std::vector<OracleEdge>& edges, Meeting kind) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      count += meetingOf(edges[i].a, edges[i].b, edges[j].a, edges[j].b) == kind;
    }
  }
  return count;
}

}  // namespace mrpt_polyloc::test
