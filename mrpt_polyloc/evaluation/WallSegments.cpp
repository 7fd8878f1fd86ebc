#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mrpt_polyloc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFarthest = 1e9;  // [m], of coordinates

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

/// The same to a disc whose centre is relative to the origin.
double rangeTo(const TPoint2D& center, double radius, const TPoint2D& ray) {
  const double ahead = dot(ray, center), aside = cross(ray, center);
  const double half_chord2 = radius * radius - aside * aside;
  if (half_chord2 < 0.0) return kInfinity;
  const double half_chord = std::sqrt(half_chord2);
  if (ahead + half_chord < 0.0) return kInfinity;
  return std::max(ahead - half_chord, 0.0);
}

}  // namespace

double rangeTo(const WallSegment& wall, const TPoint2D& origin, const TPoint2D& ray) {
  return rangeFromOrigin(wall.a - origin, wall.b - origin, ray);
}

void RoomChanges::check() const {
  for (const Disc& disc : discs) {
    requireInRange("discs.center.x", disc.center.x, -kFarthest, kFarthest);
    requireInRange("discs.center.y", disc.center.y, -kFarthest, kFarthest);
    requirePositive("discs.radius", disc.radius);
  }
  for (const MovedWall& wall : moved) {
    requireInRange("moved.at.x", wall.at.x, -kFarthest, kFarthest);
    requireInRange("moved.at.y", wall.at.y, -kFarthest, kFarthest);
    requireInRange("moved.by.x", wall.by.x, -kFarthest, kFarthest);
    requireInRange("moved.by.y", wall.by.y, -kFarthest, kFarthest);
  }
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

WallSegments::WallSegments(const PolygonMap& map, const RoomChanges& changes) : WallSegments(map) {
  changes.check();
  discs_ = changes.discs;
  const std::vector<WallSegment> before = segments_;
  for (const RoomChanges::MovedWall& wall : changes.moved) {
    const auto nearest = std::min_element(
        before.begin(), before.end(), [&](const WallSegment& a, const WallSegment& b) {
          return distanceToSegment(wall.at, a.a, a.b) < distanceToSegment(wall.at, b.a, b.b);
        });
    if (nearest == before.end()) break;
    WallSegment& moved = segments_[static_cast<std::size_t>(nearest - before.begin())];
    moved = {moved.a + wall.by, moved.b + wall.by};
  }
}

double WallSegments::range(const TPoint2D& origin, double direction) const {
  const TPoint2D ray{std::cos(direction), std::sin(direction)};
  double nearest = kInfinity;
  for (const WallSegment& segment : segments_) {
    nearest = std::min(nearest, rangeTo(segment, origin, ray));
  }
  for (const RoomChanges::Disc& disc : discs_) {
    nearest = std::min(nearest, rangeTo(disc.center - origin, disc.radius, ray));
  }
  return nearest;
}

double WallSegments::distance(const TPoint2D& point) const {
  double nearest = kInfinity;
  for (const WallSegment& segment : segments_) {
    nearest = std::min(nearest, distanceToSegment(point, segment.a, segment.b));
  }
  for (const RoomChanges::Disc& disc : discs_) {
    const TPoint2D offset = point - disc.center;
    nearest = std::min(nearest, std::max(std::hypot(offset.x, offset.y) - disc.radius, 0.0));
  }
  return nearest;
}

}  // namespace mrpt_polyloc
