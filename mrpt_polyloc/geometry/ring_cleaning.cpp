#include <mrpt_polyloc/geometry/ring_cleaning.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Rings that enclose no more than this [m2] (a square of a micrometre) have no inside.
constexpr double kZeroArea = 1e-12;

bool same(const TPoint2D& a, const TPoint2D& b) {
  return a.x == b.x && a.y == b.y;
}

/// Of three collinear points, whether a and b lie on the same side of tip.
bool isReversal(const TPoint2D& a, const TPoint2D& tip, const TPoint2D& b) {
  if (CGAL::orientation(Kernel::Point_2(a.x, a.y), Kernel::Point_2(tip.x, tip.y),
                        Kernel::Point_2(b.x, b.y)) != CGAL::COLLINEAR) {
    return false;
  }
  return a.x != tip.x ? (a.x < tip.x) == (b.x < tip.x) && b.x != tip.x
                      : (a.y < tip.y) == (b.y < tip.y);
}

/// Whether a, not the tip's other neighbour b, is the nearer to the tip; all three collinear.
bool isNearer(const TPoint2D& a, const TPoint2D& tip, const TPoint2D& b) {
  return a.x != tip.x ? std::abs(a.x - tip.x) < std::abs(b.x - tip.x)
                      : std::abs(a.y - tip.y) < std::abs(b.y - tip.y);
}

/// Takes repeated vertices and spikes out of one ring, in a circular list so that what a removal
/// brings together is looked at again.
class RingCleaner {
 public:
  RingCleaner(const Ring& ring, Findings& findings)
      : ring_(ring),
        findings_(findings),
        previous_(ring.size()),
        next_(ring.size()),
        removed_(ring.size(), false),
        on_spike_(ring.size(), false),
        left_(ring.size()) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      previous_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
    }
  }

  Ring run() {
    std::vector<std::size_t> queue(ring_.size());
    std::iota(queue.rbegin(), queue.rend(), std::size_t{0});
    while (!queue.empty() && left_ >= 2) {
      const std::size_t i = queue.back();
      queue.pop_back();
      if (removed_[i] || !step(i)) continue;
      const std::size_t at = removed_[i] ? previous_[i] : i;
      queue.insert(queue.end(), {next_[at], at, previous_[at]});
    }
    Ring clean;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      if (removed_[i]) continue;
      clean.vertices.push_back(ring_.vertices[i]);
      clean.kinds.push_back(ring_.kinds[i]);
    }
    return clean;
  }

 private:
  void remove(std::size_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    removed_[i] = true;
    --left_;
  }

  /// Whether something was removed at or after vertex i.
  bool step(std::size_t i) {
    const std::size_t before = previous_[i];
    const std::size_t after = next_[i];
    const TPoint2D& point = ring_.vertices[i];
    if (same(point, ring_.vertices[after])) {
      ring_.kinds[i] = ring_.kinds[after];  // the edge between them has no length
      remove(after);
      if (!on_spike_[i] && !on_spike_[after]) {
        findings_.repaired("repeated vertex", "removed a repeated vertex", point);
      }
      return true;
    }
    if (same(point, ring_.vertices[before])) return false;  // comes up at the vertex before
    if (!isReversal(ring_.vertices[before], point, ring_.vertices[after])) return false;
    // A spike of several edges is one defect, found at its tip and taken back edge by edge.
    if (!on_spike_[i]) findings_.repaired("spike", "removed a spike", point);
    if (isNearer(ring_.vertices[before], point, ring_.vertices[after])) {
      ring_.kinds[before] = ring_.kinds[i];
      on_spike_[before] = true;
    } else {
      on_spike_[after] = true;
      if (same(ring_.vertices[before], ring_.vertices[after])) on_spike_[before] = true;
    }
    remove(i);
    return true;
  }

  Ring ring_;
  Findings& findings_;
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> next_;
  std::vector<bool> removed_;
  std::vector<bool> on_spike_;  // where a spike was taken back to
  std::size_t left_;
};

/// Area counted positive whichever way it is run around: zero only where there is no inside, not
/// where the loops of a figure of eight cancel.
double unsignedArea(const std::vector<TPoint2D>& v) {
  double area = 0.0;
  for (std::size_t i = 2; i < v.size(); ++i) {
    area += std::abs(signedArea({v[0], v[i - 1], v[i]}));
  }
  return area;
}

/// Reports the first coordinate that cannot be used, if there is one.
bool reportBadCoordinate(const std::vector<TPoint2D>& points, Findings& findings) {
  for (const TPoint2D& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      findings.refused("coordinate that is not finite", p);
      return true;
    }
    if (std::abs(p.x) > kMaxCoordinate || std::abs(p.y) > kMaxCoordinate) {
      findings.refused("coordinate beyond 1e9 m", p);
      return true;
    }
  }
  return false;
}

void reportDegenerate(const char* what, bool is_outer, const TPoint2D& where, Findings& findings) {
  if (is_outer) {
    findings.refused(std::string("outer ring ") + what, where);
  } else {
    findings.repaired(std::string("hole ") + what, std::string("dropped a hole ") + what, where);
  }
}

/// Appends the clean ring, or reports why there is none.
void cleanRing(Ring ring, int polygon, bool is_outer, Findings& findings,
               std::vector<CleanRing>& clean) {
  if (ring.kinds.size() != ring.size()) {
    findings.refused("ring whose edge kinds do not match its vertices",
                     ring.size() > 0 ? ring.vertices[0] : TPoint2D(0, 0));
    return;
  }
  if (reportBadCoordinate(ring.vertices, findings)) return;
  for (TPoint2D& p : ring.vertices) p = {p.x + 0.0, p.y + 0.0};  // -0 and 0 are one coordinate
  if (ring.size() > 1 && same(ring.vertices.front(), ring.vertices.back())) {
    ring.vertices.pop_back();
    ring.kinds.pop_back();
  }
  if (ring.size() < 3) {
    reportDegenerate("with fewer than three vertices", is_outer,
                     ring.size() > 0 ? ring.vertices[0] : TPoint2D(0, 0), findings);
    return;
  }
  const TPoint2D first = ring.vertices[0];
  Findings removals;
  ring = RingCleaner(ring, removals).run();
  if (ring.size() < 3 || unsignedArea(ring.vertices) <= kZeroArea) {
    reportDegenerate("of zero area", is_outer, first, findings);
    return;
  }
  findings.defects.insert(findings.defects.end(), removals.defects.begin(), removals.defects.end());
  findings.repairs.insert(findings.repairs.end(), removals.repairs.begin(), removals.repairs.end());
  if (signedArea(ring.vertices) < 0.0) ring = reversed(ring);
  clean.push_back({std::move(ring), polygon, is_outer});
}

}  // namespace

Ring reversed(const Ring& ring) {
  Ring back = ring;
  if (back.size() > 1) std::reverse(back.vertices.begin() + 1, back.vertices.end());
  std::reverse(back.kinds.begin(), back.kinds.end());
  return back;
}

std::vector<CleanRing> cleanRings(const std::vector<RawPolygon>& polygons, Findings& findings) {
  std::vector<CleanRing> clean;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const int polygon = static_cast<int>(p);
    cleanRing(polygons[p].outer, polygon, true, findings, clean);
    for (const Ring& hole : polygons[p].holes) cleanRing(hole, polygon, false, findings, clean);
  }
  return clean;
}

std::vector<Polyline> cleanWalls(const std::vector<Polyline>& walls, Findings& findings) {
  std::vector<Polyline> clean;
  for (const Polyline& wall : walls) {
    if (reportBadCoordinate(wall, findings)) continue;
    Polyline kept;
    for (const TPoint2D& p : wall) {
      if (!kept.empty() && same(kept.back(), p)) {
        findings.repaired("repeated point of a wall beyond", "removed a repeated point", p);
      } else {
        kept.push_back(p);
      }
    }
    if (kept.size() >= 2) {
      clean.push_back(std::move(kept));
    } else {
      findings.repaired("wall beyond of no length", "dropped a wall beyond of no length",
                        kept.empty() ? TPoint2D(0, 0) : kept[0]);
    }
  }
  return clean;
}

}  // namespace mrpt_polyloc
