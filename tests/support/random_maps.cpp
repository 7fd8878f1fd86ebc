#include "random_maps.h"

#include "rectangle_canvas.h"
#include <mrpt_polyloc/base/angles.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace mrpt_polyloc::test {
namespace {

/// To a lattice of 5 cm, so that things touch exactly or keep a distance.
double snap(double value) {
  return std::round(value * 20.0) / 20.0;
}

/// Draws in a way that does not depend on the standard library's distributions.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : random_(seed) {}
  double uniform(double from, double to) {
    return from + (to - from) * static_cast<double>(random_()) / 4294967296.0;
  }
  bool chance(double share) { return uniform(0, 1) < share; }
  /// On the lattice.
  double snapped(double from, double to) { return snap(uniform(from, to)); }

 private:
  std::mt19937 random_;
};

class FloorPlanBuilder {
 public:
  FloorPlanBuilder(const FloorPlanParams& params, std::uint32_t seed) : p_(params), dice_(seed) {}

  PolygonMap build() {
    const double pitch = 2 * p_.room_depth + p_.corridor_width + 3 * p_.wall;
    const double width = p_.rooms_per_side * (p_.room_width + p_.wall);
    for (int i = 0; i < p_.corridors; ++i) {
      const double y = i * pitch;
      paint(0, y, width, y + p_.corridor_width, Paint::free);
      for (int k = 0; k < p_.rooms_per_side; ++k) {
        const double x = k * (p_.room_width + p_.wall);
        addRoom(x, y + p_.corridor_width + p_.wall, y + p_.corridor_width);
        addRoom(x, y - p_.wall - p_.room_depth, y - p_.wall);
      }
    }
    paint(-p_.corridor_width, 0, 0, (p_.corridors - 1) * pitch + p_.corridor_width, Paint::free);
    for (int i = 0; i < p_.crossing_walls; ++i) {
      const double y0 = -p_.room_depth, y1 = p_.corridors * pitch;
      walls_.push_back({{dice_.uniform(-3, width), dice_.uniform(y0, y1)},
                        {dice_.uniform(-3, width), dice_.uniform(y0, y1)}});
    }
    std::vector<FreePolygon> polygons = canvas_.freeSpace();
    for (Ring& hole : loose_) addRing(polygons, std::move(hole));
    for (FreePolygon& polygon : polygons) {
      finish(polygon.outer);
      for (Ring& hole : polygon.holes) finish(hole);
    }
    for (Polyline& wall : walls_) {
      for (TPoint2D& p : wall) p = placed(p);
    }
    return PolygonMap(std::move(polygons), std::move(walls_));
  }

 private:
  void paint(double x0, double y0, double x1, double y1, Paint paint) {
    canvas_.paint(snap(x0), snap(y0), snap(x1), snap(y1), paint);
  }

  /// A room whose lower left corner is (x, y); its door goes through the wall that starts at
  /// door_y.
  void addRoom(double x, double y, double door_y) {
    paint(x, y, x + p_.room_width, y + p_.room_depth, Paint::free);
    const double door_x = dice_.snapped(x + 0.2, x + p_.room_width - p_.door - 0.2);
    paint(door_x, door_y, door_x + p_.door, door_y + p_.wall, Paint::free);
    if (dice_.chance(p_.unknown_share)) addUnknown(x, y);
    int loose = 0;
    for (int i = 0; i < p_.furniture_per_room; ++i) {
      if (dice_.chance(0.4)) {
        addBlock(x, y);
      } else {
        ++loose;
      }
    }
    for (; loose > 0; --loose) addLoose(x, y);  // last: nothing is painted over them
  }

  void addUnknown(double x, double y) {
    const double x0 = dice_.snapped(x, x + p_.room_width - 1.0);
    const double y0 = dice_.snapped(y + 0.5, y + p_.room_depth - 1.5);
    const double x1 = dice_.snapped(x0 + 0.3, x + p_.room_width);
    const double y1 = dice_.snapped(y0 + 0.3, y0 + 1.0);
    paint(x0, y0, x1, y1, Paint::unknown);
    const auto inside = [&] { return TPoint2D(dice_.uniform(x0, x1), dice_.uniform(y0, y1)); };
    walls_.push_back({inside(), inside(), inside()});
    if (dice_.chance(0.5)) return;
    // A window in the wall to the next room, unknown, that ends in free or unknown space there.
    const double w0 = dice_.snapped(y + 0.2, y + p_.room_depth - 0.6);
    paint(x + p_.room_width, w0, x + p_.room_width + p_.wall, w0 + 0.4, Paint::unknown);
    walls_.push_back({{x + p_.room_width + 0.5 * p_.wall, w0 - 0.3},
                      {x + p_.room_width + 0.5 * p_.wall, w0 + dice_.uniform(0, 0.4)}});
  }

  /// A block against a wall.
  void addBlock(double x, double y) {
    const double x0 = dice_.chance(0.5) ? x : x + p_.room_width - 0.6;
    const double y0 = dice_.snapped(y + 0.3, y + p_.room_depth - 1.3);
    paint(x0, y0, x0 + 0.6, dice_.snapped(y0 + 0.3, y0 + 1.0), Paint::solid);
  }

  /// A block that stands free, if there is room for it.
  void addLoose(double x, double y) {
    for (int attempt = 0; attempt < 20; ++attempt) {
      const TPoint2D center(dice_.uniform(x + 0.8, x + p_.room_width - 0.8),
                            dice_.uniform(y + 0.8, y + p_.room_depth - 0.8));
      const double radius = dice_.uniform(0.1, 0.4);
      if (!isClear(center, radius + 0.1)) continue;
      addHole(center, radius);
      return;
    }
  }

  bool isClear(const TPoint2D& center, double radius) const {
    for (double x = -radius; x <= radius; x += radius / 8) {
      for (double y = -radius; y <= radius; y += radius / 8) {
        if (canvas_.at({center.x + x, center.y + y}) != Paint::free) return false;
      }
    }
    return std::none_of(centers_.begin(), centers_.end(), [&](const auto& other) {
      return std::hypot(center.x - other.first.x, center.y - other.first.y) < radius + other.second;
    });
  }

  void addHole(const TPoint2D& center, double radius) {
    centers_.emplace_back(center, radius);
    const int corners = static_cast<int>(dice_.uniform(3, 7));
    const double start = dice_.uniform(0, 2 * kPi);
    const bool open = dice_.chance(p_.unknown_share);
    Ring hole;
    for (int i = 0; i < corners; ++i) {
      const double angle = start - 2 * kPi * i / corners;  // clockwise
      hole.vertices.emplace_back(center.x + radius * std::cos(angle),
                                 center.y + radius * std::sin(angle));
      hole.kinds.push_back(open && dice_.chance(0.7) ? EdgeKind::open : EdgeKind::wall);
    }
    loose_.push_back(std::move(hole));
  }

  /// Cuts a ring's edges, moves its vertices a little and puts it in its place.
  void finish(Ring& ring) {
    Ring result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const TPoint2D &a = ring.vertices[i], &b = ring.vertices[(i + 1) % ring.size()];
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      const int pieces =
          p_.edge_length > 0 ? std::max(1, static_cast<int>(length / p_.edge_length)) : 1;
      for (int k = 0; k < pieces; ++k) {
        const double s = static_cast<double>(k) / pieces;
        result.vertices.push_back(placed(jittered({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)})));
        result.kinds.push_back(ring.kinds[i]);
      }
    }
    ring = std::move(result);
  }

  /// Moved by an amount that depends on the point alone: rings that touch in a point still do.
  TPoint2D jittered(const TPoint2D& p) const {
    if (p_.jitter <= 0) return p;
    std::uint64_t bits[2];
    std::memcpy(&bits[0], &p.x, 8);
    std::memcpy(&bits[1], &p.y, 8);
    Dice dice(static_cast<std::uint32_t>((bits[0] * 31 + bits[1]) * 0x9E3779B97F4A7C15ULL >> 32));
    return {p.x + dice.uniform(-p_.jitter, p_.jitter), p.y + dice.uniform(-p_.jitter, p_.jitter)};
  }

  TPoint2D placed(const TPoint2D& p) const {
    const double c = std::cos(p_.rotation), s = std::sin(p_.rotation);
    return {c * p.x - s * p.y + p_.offset.x, s * p.x + c * p.y + p_.offset.y};
  }

  FloorPlanParams p_;
  Dice dice_;
  RectangleCanvas canvas_;
  std::vector<Ring> loose_;
  std::vector<std::pair<TPoint2D, double>> centers_;
  std::vector<Polyline> walls_;
};

}  // namespace

PolygonMap floorPlan(const FloorPlanParams& params, std::uint32_t seed) {
  return FloorPlanBuilder(params, seed).build();
}

FloorPlanParams smallFlat() {
  FloorPlanParams params;
  params.rooms_per_side = 6;
  params.room_width = 3.0;
  params.room_depth = 3.0;
  return params;
}

FloorPlanParams largeFloor() {
  FloorPlanParams params;
  params.corridors = 3;
  params.rooms_per_side = 20;
  params.room_width = 3.0;
  params.room_depth = 3.2;
  return params;
}

FloorPlanParams furnishedFloor() {
  FloorPlanParams params = largeFloor();
  params.rooms_per_side = 10;
  params.room_width = 6.0;
  params.furniture_per_room = 3;
  return params;
}

FloorPlanParams noisyFloor() {
  FloorPlanParams params = furnishedFloor();
  params.edge_length = 0.2;
  params.jitter = 0.02;
  params.unknown_share = 0.5;
  return params;
}

FloorPlanParams randomParams(std::mt19937& random) {
  Dice dice(static_cast<std::uint32_t>(random()));
  FloorPlanParams params;
  params.corridors = static_cast<int>(dice.uniform(1, 3));
  params.rooms_per_side = static_cast<int>(dice.uniform(1, 5));
  params.room_width = dice.uniform(2.5, 6.0);
  params.room_depth = dice.uniform(2.5, 6.0);
  params.furniture_per_room = static_cast<int>(dice.uniform(0, 5));
  params.unknown_share = dice.chance(0.7) ? dice.uniform(0.2, 1.0) : 0.0;
  params.crossing_walls = dice.chance(0.3) ? 3 : 0;
  if (dice.chance(0.5)) {
    params.edge_length = dice.uniform(0.15, 0.6);
    params.jitter = 0.02;
  }
  params.rotation = dice.chance(0.5) ? dice.uniform(-kPi, kPi) : 0.0;
  params.offset = {dice.uniform(-50, 50), dice.uniform(-50, 50)};
  return params;
}

std::vector<TPoint2D> randomPoints(const PolygonMap& map, double margin, std::size_t count,
                                   std::mt19937& random) {
  const BoundingBox& box = map.boundingBox();
  Dice dice(static_cast<std::uint32_t>(random()));
  std::vector<TPoint2D> points(count);
  for (TPoint2D& p : points) {
    p = {dice.uniform(box.min.x - margin, box.max.x + margin),
         dice.uniform(box.min.y - margin, box.max.y + margin)};
  }
  return points;
}

std::vector<TPoint2D> randomFreePoints(const PolygonMap& map, std::size_t count,
                                       std::mt19937& random) {
  std::vector<TPoint2D> points;
  while (points.size() < count) {
    for (const TPoint2D& p : randomPoints(map, 0.0, count, random)) {
      if (points.size() < count && map.contains(p)) points.push_back(p);
    }
  }
  return points;
}

}  // namespace mrpt_polyloc::test
