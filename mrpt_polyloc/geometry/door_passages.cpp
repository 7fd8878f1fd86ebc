#include <mrpt_polyloc/geometry/door_passages.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr double kStep = 0.01;     // [m], of looking for a room
constexpr double kOverlap = 0.02;  // [m], into the rooms: a union joins what overlaps
constexpr std::array<double, 5> kPlaces = {0.02, 0.25, 0.5, 0.75, 0.98};  // along a door

/// Whether a ray to the right crosses the ring an odd number of times.
bool crossesOddly(const Ring& ring, const TPoint2D& p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const TPoint2D &a = ring.vertices[i], &b = ring.vertices[(i + 1) % ring.size()];
    if ((a.y <= p.y) == (b.y <= p.y)) continue;
    odd ^= a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x;
  }
  return odd;
}

bool isInRoom(const std::vector<RawPolygon>& rooms, const TPoint2D& p) {
  return std::any_of(rooms.begin(), rooms.end(), [&p](const RawPolygon& room) {
    bool odd = crossesOddly(room.outer, p);
    for (const Ring& hole : room.holes) odd ^= crossesOddly(hole, p);
    return odd;
  });
}

/// How far off along `side` the nearest room is, if it is near enough [m].
std::optional<double> distanceToRoom(const std::vector<RawPolygon>& rooms, const TPoint2D& from,
                                     const TPoint2D& side) {
  for (double t = 0.0; t <= kThickestDoorWall + 0.5 * kStep; t += kStep) {
    if (isInRoom(rooms, from + side * t)) return t;
  }
  return std::nullopt;
}

std::optional<RawPolygon> passage(const std::vector<RawPolygon>& rooms, const TPoint2D& a,
                                  const TPoint2D& b) {
  const TPoint2D along = b - a;
  const double length = along.norm();
  if (length == 0.0) return std::nullopt;
  const TPoint2D left(-along.y / length, along.x / length);
  double to_left = 0.0, to_right = 0.0;
  for (const double place : kPlaces) {
    const TPoint2D p = a + along * place;
    const auto there = distanceToRoom(rooms, p, left), here = distanceToRoom(rooms, p, left * -1.0);
    if (!there || !here) return std::nullopt;
    to_left = std::max(to_left, *there);
    to_right = std::max(to_right, *here);
  }
  const double thickness = to_left + to_right;
  if (thickness == 0.0 || thickness > kThickestDoorWall + 2.0 * kStep) return std::nullopt;
  const TPoint2D up = left * (to_left + kOverlap), down = left * -(to_right + kOverlap);
  return RawPolygon{wallRing({a + down, b + down, b + up, a + up}), {}};
}

}  // namespace

std::vector<RawPolygon> doorPassages(const std::vector<RawPolygon>& rooms,
                                     const std::vector<Polyline>& doors) {
  std::vector<RawPolygon> passages;
  for (const Polyline& door : doors) {
    for (std::size_t i = 0; i + 1 < door.size(); ++i) {
      if (auto found = passage(rooms, door[i], door[i + 1])) passages.push_back(std::move(*found));
    }
  }
  return passages;
}

}  // namespace mrpt_polyloc
