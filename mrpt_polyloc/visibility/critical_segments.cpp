#include <mrpt_polyloc/geometry/orientation.h>
#include <mrpt_polyloc/visibility/critical_segments.h>

#include <cmath>
#include <cstddef>

namespace mrpt_polyloc {
namespace {

constexpr std::int32_t kNone = Triangulation::kNone;

/// Free faces around a vertex between two boundary edges, counterclockwise.
struct Sector {
  struct Slice {
    std::int32_t face;
    std::int32_t corner;  ///< which vertex of the face the apex is
  };
  std::vector<Slice> slices;
  std::int32_t first, last;  ///< the far ends of the bounding edges, in this order
};

/// Where a ray stops: on the edge from `right` to `left`, or at one vertex.
struct Stop {
  std::int32_t right = kNone;
  std::int32_t left = kNone;
  bool exists() const { return right != kNone; }
  bool isVertex() const { return right == left; }
};

class Finder {
 public:
  Finder(const Triangulation& triangulation, double range)
      : t_(triangulation), range_(range), sectors_(triangulation.vertices().size()) {
    for (std::size_t f = 0; f < t_.faces().size(); ++f) {
      if (!t_.faces()[f].is_free) continue;
      // A sector starts at each face whose edge on the right of the apex is boundary.
      for (std::int32_t i = 0; i < 3; ++i) {
        if (isBoundary(static_cast<std::int32_t>(f), (i + 2) % 3)) {
          addSector(static_cast<std::int32_t>(f), i);
        }
      }
    }
  }

  CriticalSegments find() {
    for (std::size_t v = 0; v < sectors_.size(); ++v) {
      for (const Sector& sector : sectors_[v]) {
        const auto blocker = static_cast<std::int32_t>(v);
        if (turn(sector.last, blocker, sector.first) < 0) findBlockedBy(blocker, sector);
      }
    }
    return std::move(found_);
  }

 private:
  const TPoint2D& point(std::int32_t v) const { return t_.vertices()[static_cast<std::size_t>(v)]; }
  const Triangulation::Face& face(std::int32_t f) const {
    return t_.faces()[static_cast<std::size_t>(f)];
  }
  std::int32_t vertexOf(std::int32_t f, std::int32_t i) const {
    return face(f).vertex[static_cast<std::size_t>(i % 3)];
  }
  int turn(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return orientation(point(a), point(b), point(c));
  }
  double distance(std::int32_t a, std::int32_t b) const {
    return std::hypot(point(a).x - point(b).x, point(a).y - point(b).y);
  }
  /// Whether free space ends at an edge of a free face.
  bool isBoundary(std::int32_t f, std::int32_t edge) const {
    const auto e = static_cast<std::size_t>(edge);
    return face(f).passage[e] != Passage::clear || face(f).neighbor[e] == kNone ||
           !face(face(f).neighbor[e]).is_free;
  }
  /// The edge of the neighbour across an edge.
  std::int32_t entryEdge(std::int32_t f, std::int32_t next) const {
    std::int32_t entered = 0;
    while (face(next).neighbor[static_cast<std::size_t>(entered)] != f) ++entered;
    return entered;
  }

  void addSector(std::int32_t f, std::int32_t i) {
    const std::int32_t apex = vertexOf(f, i);
    Sector sector;
    sector.first = vertexOf(f, i + 1);
    for (;;) {
      sector.slices.push_back({f, i});
      const std::int32_t edge = (i + 1) % 3;  // from the apex to what is left of it
      if (isBoundary(f, edge)) break;
      const std::int32_t next = face(f).neighbor[static_cast<std::size_t>(edge)];
      i = (entryEdge(f, next) + 1) % 3;
      f = next;
    }
    sector.last = vertexOf(f, i + 2);
    sectors_[static_cast<std::size_t>(apex)].push_back(std::move(sector));
  }

  /// Follows the ray from `v` away from `u` through a sector of v, up to the first vertex touched
  /// or edge of the boundary met, or the first edge of the triangulation `reach` from v. None if
  /// the ray leaves the sector or runs along its border.
  Stop follow(std::int32_t u, std::int32_t v, const Sector& sector, double reach) const {
    for (const Sector::Slice& slice : sector.slices) {
      const std::int32_t a = vertexOf(slice.face, slice.corner + 1);
      const std::int32_t b = vertexOf(slice.face, slice.corner + 2);
      const int side_a = turn(u, v, a), side_b = turn(u, v, b);
      if (side_a > 0 || side_b < 0) continue;
      if (side_a == 0) return {a, a};
      if (side_b == 0) return {b, b};
      return walk(u, v, slice.face, slice.corner, reach);
    }
    return {};
  }

  /// The ray enters through edge `edge` of a face: it leaves through it.
  Stop walk(std::int32_t u, std::int32_t v, std::int32_t f, std::int32_t edge, double reach) const {
    for (;;) {
      const std::int32_t right = vertexOf(f, edge + 1), left = vertexOf(f, edge + 2);
      if (isBoundary(f, edge) || isBeyond(u, v, right, left, reach)) return {right, left};
      const std::int32_t next = face(f).neighbor[static_cast<std::size_t>(edge)];
      const std::int32_t entered = entryEdge(f, next);
      const std::int32_t apex = vertexOf(next, entered);
      const int side = turn(u, v, apex);
      if (side == 0) return {apex, apex};
      // An apex left of the ray leaves the edge on the right to leave through, from the vertex
      // entered + 2 to the apex.
      edge = side > 0 ? (entered + 1) % 3 : (entered + 2) % 3;
      f = next;
    }
  }
  bool isBeyond(std::int32_t u, std::int32_t v, std::int32_t right, std::int32_t left,
                double reach) const {
    if (std::isinf(reach)) return false;
    const TPoint2D end = endOf({u, v, right, left, false, 0, 0}, t_.vertices());
    return std::hypot(end.x - point(v).x, end.y - point(v).y) >= reach;
  }

  /// What the blocker sees through a sector, nearest vertices only: the segments away from them.
  void findBlockedBy(std::int32_t v, const Sector& sector) {
    add(sector.first, v, sector);
    for (const Sector::Slice& slice : sector.slices) {
      add(vertexOf(slice.face, slice.corner + 2), v, sector);
      gaps_.push_back({slice.face, slice.corner, vertexOf(slice.face, slice.corner + 1),
                       vertexOf(slice.face, slice.corner + 2)});
      while (!gaps_.empty()) {
        const Gap gap = gaps_.back();
        gaps_.pop_back();
        expand(gap, v, sector);
      }
    }
  }
  struct Gap {
    std::int32_t face, edge;
    std::int32_t right, left;
  };
  void expand(const Gap& gap, std::int32_t v, const Sector& sector) {
    if (isBoundary(gap.face, gap.edge)) return;
    const std::int32_t next = face(gap.face).neighbor[static_cast<std::size_t>(gap.edge)];
    const std::int32_t entered = entryEdge(gap.face, next);
    const std::int32_t apex = vertexOf(next, entered);
    const bool sees_right = turn(v, gap.right, apex) > 0;
    const bool sees_left = turn(v, gap.left, apex) < 0;
    if (sees_right && sees_left) add(apex, v, sector);
    if (sees_left) {
      gaps_.push_back({next, (entered + 2) % 3, sees_right ? apex : gap.right, gap.left});
    }
    if (sees_right) {
      gaps_.push_back({next, (entered + 1) % 3, gap.right, sees_left ? apex : gap.left});
    }
  }

  void add(std::int32_t u, std::int32_t v, const Sector& sector) {
    const double length = distance(u, v);
    if (std::isfinite(range_) && length >= range_ && u != sector.first && u != sector.last) return;
    const Stop stop = follow(u, v, sector, range_ - length);
    if (!stop.exists() || isAlongBoundary(stop, sector)) return;
    const int side =
        turn(u, v, sector.first) != 0 ? turn(u, v, sector.first) : turn(u, v, sector.last);
    CriticalSegment segment{u,         v,        stop.right,
                            stop.left, side > 0, static_cast<std::uint32_t>(found_.flipped.size()),
                            0};
    addFlipped(u, v, side);
    segment.flipped_count =
        static_cast<std::uint32_t>(found_.flipped.size()) - segment.first_flipped;
    found_.segments.push_back(segment);
  }
  static bool isAlongBoundary(const Stop& stop, const Sector& sector) {
    return stop.isVertex() && (stop.right == sector.first || stop.right == sector.last);
  }

  /// u flips, and what lies behind it on the line, up to and with the first vertex whose obstacle
  /// stands on the other side: what is behind that one is seen from neither side.
  void addFlipped(std::int32_t u, std::int32_t v, int side) {
    for (;;) {
      found_.flipped.push_back(u);
      const Stop behind = behindVertex(v, u, side);
      if (!behind.exists() || !behind.isVertex()) return;
      v = u;
      u = behind.right;
    }
  }
  /// The ray from u away from v, if it goes on in a sector of u whose obstacle is on `side` of the
  /// direction u to v.
  Stop behindVertex(std::int32_t v, std::int32_t u, int side) const {
    for (const Sector& sector : sectors_[static_cast<std::size_t>(u)]) {
      if (turn(sector.last, u, sector.first) > 0) continue;
      const int first = turn(v, u, sector.first), last = turn(v, u, sector.last);
      // The direction v to u is the opposite one: an obstacle on `side` is at -side of it.
      if (first * side > 0 || last * side > 0) continue;
      if (!holdsDirection(sector, u, v)) continue;
      if (first == 0 && last == 0) {  // along a straight wall: free space is on the other side
        const std::int32_t next = side > 0 ? sector.first : sector.last;
        if (!isAhead(v, u, next)) continue;
        return {next, next};
      }
      const Stop stop = follow(v, u, sector, kUnlimitedRange);
      if (stop.exists()) return stop;
    }
    return {};
  }
  bool isAhead(std::int32_t from, std::int32_t at, std::int32_t to) const {
    const TPoint2D &a = point(from), &b = point(at), &c = point(to);
    return (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) > 0.0;
  }
  /// Whether the direction from u to v lies in a closed sector of u.
  bool holdsDirection(const Sector& sector, std::int32_t u, std::int32_t v) const {
    for (const Sector::Slice& slice : sector.slices) {
      if (turn(u, vertexOf(slice.face, slice.corner + 1), v) >= 0 &&
          turn(u, vertexOf(slice.face, slice.corner + 2), v) <= 0) {
        return true;
      }
    }
    return false;
  }

  const Triangulation& t_;
  double range_;
  std::vector<std::vector<Sector>> sectors_;  // of each vertex
  std::vector<Gap> gaps_;
  CriticalSegments found_;
};

}  // namespace

CriticalSegments criticalSegments(const Triangulation& triangulation, double range) {
  return Finder(triangulation, range).find();
}

TPoint2D endOf(const CriticalSegment& segment, const std::vector<TPoint2D>& vertices) {
  const auto at = [&](std::int32_t v) { return vertices[static_cast<std::size_t>(v)]; };
  const TPoint2D a = at(segment.right), b = at(segment.left);
  if (segment.right == segment.left) return a;
  const TPoint2D u = at(segment.behind), v = at(segment.blocker);
  const auto side = [&](const TPoint2D& p) {
    return (v.x - u.x) * (p.y - v.y) - (v.y - u.y) * (p.x - v.x);
  };
  const double share = side(a) / (side(a) - side(b));
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

}  // namespace mrpt_polyloc
