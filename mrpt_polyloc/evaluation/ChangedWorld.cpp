#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/ChangedWorld.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mrpt_polyloc {
namespace {

constexpr double kLargestGone = 4.0;  // [m2]: a cupboard, no inner courtyard
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGlassCosine = 0.965925826289;  // 15 degrees

/// The left normal of the edge from a to b, which points into free space; null if they are one.
TPoint2D normalOf(const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D edge = b - a;
  const double length = std::hypot(edge.x, edge.y);
  return length > 0.0 ? TPoint2D{-edge.y / length, edge.x / length} : TPoint2D{0, 0};
}

/// The corner of two edges that moved along their normals.
TPoint2D movedCorner(const TPoint2D& corner, const TPoint2D& normal_before, double shift_before,
                     const TPoint2D& normal_after, double shift_after) {
  constexpr double kNearlyParallel = 0.3;  // sine of the turn; else the corner would run away
  const double turn = cross(normal_before, normal_after);
  if (std::abs(turn) < kNearlyParallel) {
    return corner + 0.5 * (shift_before * normal_before + shift_after * normal_after);
  }
  return {corner.x + (shift_before * normal_after.y - shift_after * normal_before.y) / turn,
          corner.y + (shift_after * normal_before.x - shift_before * normal_after.x) / turn};
}

double drawShift(double deviation, Random& random) {
  return deviation * std::clamp(random.normal(), -3.0, 3.0);
}

std::vector<TPoint2D> shiftedRing(const Ring& ring, double deviation, Random& random) {
  const std::size_t n = ring.size();
  std::vector<double> shifts(n);
  for (double& shift : shifts) shift = drawShift(deviation, random);
  if (deviation == 0.0) return ring.vertices;
  std::vector<TPoint2D> vertices(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    vertices[i] = movedCorner(ring.vertices[i], normalOf(ring.vertices[before], ring.vertices[i]),
                              shifts[before],
                              normalOf(ring.vertices[i], ring.vertices[(i + 1) % n]), shifts[i]);
  }
  return vertices;
}

bool canBeGone(const Ring& hole) {
  const auto is_open = [](EdgeKind kind) { return kind == EdgeKind::open; };
  return std::none_of(hole.kinds.begin(), hole.kinds.end(), is_open) &&
         std::abs(signedArea(hole.vertices)) <= kLargestGone;
}

std::vector<WallSegment> drawBox(const TPoint2D& middle, Random& random) {
  const double half_length = 0.5 * random.uniform(0.4, 1.2);
  const double half_width = 0.5 * random.uniform(0.4, 1.2);
  const double turn = random.uniform(0.0, kPi);
  const TPoint2D along{half_length * std::cos(turn), half_length * std::sin(turn)};
  const TPoint2D across{-half_width * std::sin(turn), half_width * std::cos(turn)};
  const TPoint2D corners[] = {middle + along + across, middle - along + across,
                              middle - along - across, middle + along - across};
  std::vector<WallSegment> box;
  for (std::size_t i = 0; i < 4; ++i) box.push_back({corners[i], corners[(i + 1) % 4]});
  return box;
}

/// Whether the origin lies in the box or nearer than the clearance to it.
bool isNear(const std::vector<WallSegment>& box, const TPoint2D& origin, double clearance) {
  bool inside = true;
  for (const WallSegment& side : box) {
    if (distanceToSegment(origin, side.a, side.b) < clearance) return true;
    inside = inside && cross(side.b - side.a, origin - side.a) > 0.0;
  }
  return inside;
}

/// An arc of directions [rad], from its right end.
struct Arc {
  double right, width;
};

/// Directions in which a wall may be met, a little more than it covers: whether it is met is asked
/// of each beam.
Arc arcOf(const WallSegment& wall, const TPoint2D& origin) {
  constexpr double kSlack = 1e-6;       // [rad]: far more than rounding
  constexpr double kLeastRange = 1e-6;  // [m]: nearer, an end has no direction to speak of
  const TPoint2D a = wall.a - origin, b = wall.b - origin;
  const bool is_near = std::min(std::hypot(a.x, a.y), std::hypot(b.x, b.y)) < kLeastRange;
  const double of_a = std::atan2(a.y, a.x),
               turn = std::remainder(std::atan2(b.y, b.x) - of_a, kTwoPi);
  // From on the wall its ends are half a turn apart: all directions.
  if (is_near || std::abs(turn) > kPi - 2.0 * kSlack) return {0.0, kTwoPi};
  return {of_a + std::min(turn, 0.0) - kSlack, std::abs(turn) + 2.0 * kSlack};
}

}  // namespace

void WorldChanges::check() const {
  requireInRange("boxes", static_cast<double>(boxes), 0.0, 100'000.0);
  requireInRange("gone", gone, 0.0, 1.0);
  requireInRange("wall_shift", wall_shift, 0.0, 10.0);
  requireInRange("wing_scale", wing_scale, -0.5, 0.5);
  requireInRange("wing_turn", wing_turn, -0.5 * kPi, 0.5 * kPi);
  requireInRange("glass", glass, 0.0, 1.0);
}

ChangedWorld::ChangedWorld(const PolygonMap& map, const WorldChanges& changes, std::uint64_t seed)
    : wing_scale_(1.0 + changes.wing_scale), wing_turn_(changes.wing_turn) {
  changes.check();
  const BoundingBox& box = map.boundingBox();
  middle_ = {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y)};
  wing_is_right_ = box.max.x - box.min.x >= box.max.y - box.min.y;

  // Each kind of change has draws of its own, so that one does not alter another.
  constexpr std::uint64_t kStride = 0x9e3779b97f4a7c15ULL;
  Random gone(seed + kStride), shifts(seed + 2 * kStride), glass(seed + 3 * kStride),
      places(seed + 4 * kStride);
  const auto addWall = [&](const TPoint2D& a, const TPoint2D& b) {
    walls_.push_back({{worldPoint(a), worldPoint(b)}, glass.unit() < changes.glass});
  };
  const auto addRing = [&](const Ring& ring, bool is_hole) {
    const bool is_gone = is_hole && gone.unit() < changes.gone && canBeGone(ring);
    const std::vector<TPoint2D> vertices = shiftedRing(ring, changes.wall_shift, shifts);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring.kinds[i] == EdgeKind::open || is_gone) continue;
      addWall(vertices[i], vertices[(i + 1) % ring.size()]);
    }
  };
  for (const FreePolygon& component : map.components()) {
    addRing(component.outer, false);
    for (const Ring& hole : component.holes) addRing(hole, true);
  }
  for (const Polyline& wall : map.wallsBeyond()) {
    const TPoint2D shift{drawShift(changes.wall_shift, shifts),
                         drawShift(changes.wall_shift, shifts)};
    for (std::size_t i = 1; i < wall.size(); ++i) addWall(wall[i - 1] + shift, wall[i] + shift);
  }
  if (changes.boxes == 0) return;
  const FreeSpaceSampler sampler(map);
  for (std::size_t i = 0; i < changes.boxes; ++i) {
    boxes_.push_back(drawBox(worldPoint(sampler.draw(places)), places));
  }
}

mrpt::math::TPose2D ChangedWorld::worldPose(const mrpt::math::TPose2D& pose_map) const {
  const TPoint2D place = worldPoint({pose_map.x, pose_map.y});
  const bool in_wing = wing_is_right_ ? pose_map.x > middle_.x : pose_map.y > middle_.y;
  return {place.x, place.y, pose_map.phi + (in_wing ? wing_turn_ : 0.0)};
}

TPoint2D ChangedWorld::worldPoint(const TPoint2D& point_map) const {
  const bool in_wing = wing_is_right_ ? point_map.x > middle_.x : point_map.y > middle_.y;
  if (!in_wing || (wing_scale_ == 1.0 && wing_turn_ == 0.0)) return point_map;
  const TPoint2D arm = wing_scale_ * (point_map - middle_);
  const double c = std::cos(wing_turn_), s = std::sin(wing_turn_);
  return {middle_.x + c * arm.x - s * arm.y, middle_.y + s * arm.x + c * arm.y};
}

double ChangedWorld::rangeToWall(const Wall& wall, const TPoint2D& origin,
                                 const TPoint2D& ray) const {
  if (wall.is_glass &&
      std::abs(dot(ray, normalOf(wall.segment.a, wall.segment.b))) < kGlassCosine) {
    return kInfinity;
  }
  return rangeTo(wall.segment, origin, ray);
}

double ChangedWorld::nearestWithBoxes(double nearest, const TPoint2D& origin, const TPoint2D& ray,
                                      double clearance) const {
  for (const std::vector<WallSegment>& box : boxes_) {
    double met = kInfinity;
    for (const WallSegment& side : box) met = std::min(met, rangeTo(side, origin, ray));
    if (met < nearest && !isNear(box, origin, clearance)) nearest = met;
  }
  return nearest;
}

double ChangedWorld::range(const TPoint2D& origin, double direction, double clearance) const {
  const TPoint2D ray{std::cos(direction), std::sin(direction)};
  double nearest = kInfinity;
  for (const Wall& wall : walls_) nearest = std::min(nearest, rangeToWall(wall, origin, ray));
  return nearestWithBoxes(nearest, origin, ray, clearance);
}

std::vector<double> ChangedWorld::ranges(const TPoint2D& origin, double heading,
                                         const std::vector<double>& bearings,
                                         double clearance) const {
  std::vector<TPoint2D> rays;
  for (const double bearing : bearings) {
    rays.push_back({std::cos(heading + bearing), std::sin(heading + bearing)});
  }
  std::vector<double> ranges(bearings.size(), kInfinity);
  if (bearings.empty()) return ranges;
  for (const Wall& wall : walls_) {
    const auto [right, width] = arcOf(wall.segment, origin);
    // Turned to the first place at or behind the first beam, and once around before it.
    const double start = bearings.front() + wrapToTwoPi(right - heading - bearings.front());
    for (const double from : {start, start - kTwoPi}) {
      const auto begin = std::lower_bound(bearings.begin(), bearings.end(), from);
      const auto end = std::upper_bound(begin, bearings.end(), from + width);
      for (auto beam = begin; beam != end; ++beam) {
        const auto i = static_cast<std::size_t>(beam - bearings.begin());
        ranges[i] = std::min(ranges[i], rangeToWall(wall, origin, rays[i]));
      }
    }
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ranges[i] = nearestWithBoxes(ranges[i], origin, rays[i], clearance);
  }
  return ranges;
}

}  // namespace mrpt_polyloc
