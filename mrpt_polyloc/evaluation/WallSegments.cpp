#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Range along the unit vector `ray` to the segment from a to b, both relative to the origin.
double rangeFromOrigin(const TPoint2D& a, const TPoint2D& b, const TPoint2D& ray) {
  const double side_a = cross(ray, a), side_b = cross(ray, b);
  if ((side_a > 0.0 && side_b > 0.0) || (side_a < 0.0 && side_b < 0.0)) return kInfinity;
  double range = kInfinity;
  if (side_a == 0.0 && side_b == 0.0) {  // along the ray: its nearest point ahead
    const double at_a = dot(ray, a), at_b = dot(ray, b);
    if (at_a >= 0.0 && at_b >= 0.0) {
      range = std::min(at_a, at_b);
    } else if (at_a >= 0.0 || at_b >= 0.0) {
      range = 0.0;  // the origin lies on it
    }
  } else {
    const double t = side_a / (side_a - side_b);
    range = dot(ray, a) + t * (dot(ray, b) - dot(ray, a));
  }
  return range >= 0.0 ? range : kInfinity;
}

}  // namespace

double rangeTo(const WallSegment& wall, const TPoint2D& origin, const TPoint2D& ray) {
  return rangeFromOrigin(wall.a - origin, wall.b - origin, ray);
}

WallSegments::WallSegments(const PolygonMap& map) {
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      if (ring->kinds[i] == EdgeKind::open) continue;
      segments_.push_back({ring->vertices[i], ring->vertices[(i + 1) % ring->size()]});
    }
  }
  for (const Polyline& wall : map.wallsBeyond()) {
    for (std::size_t i = 1; i < wall.size(); ++i) segments_.push_back({wall[i - 1], wall[i]});
  }
}

double WallSegments::range(const TPoint2D& origin, double direction) const {
  const TPoint2D ray{std::cos(direction), std::sin(direction)};
  double nearest = kInfinity;
  for (const WallSegment& segment : segments_) {
    nearest = std::min(nearest, rangeTo(segment, origin, ray));
  }
  return nearest;
}

double WallSegments::distance(const TPoint2D& point) const {
  double nearest = kInfinity;
  for (const WallSegment& segment : segments_) {
    nearest = std::min(nearest, distanceToSegment(point, segment.a, segment.b));
  }
  return nearest;
}

}  // namespace mrpt_polyloc
