#include "World.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>
#include <mrpt_polyloc/io/observation.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

/// People do not stand in the robot.
SimulatorParams besideRobot(SimulatorParams laser, double robot_radius) {
  laser.check();
  laser.nearest_occluder = std::max(laser.nearest_occluder, robot_radius + 0.15);
  return laser;
}

/// Boxes that leave a robot room to pass between them and any wall.
std::vector<Polyline> placeBoxes(const PolygonMap& map, std::size_t count, double robot_radius,
                                 Random& random) {
  std::vector<Polyline> boxes;
  if (count == 0) return boxes;
  const FreeSpaceSampler sampler(map);
  const WallSegments walls(map);
  const double passage = 2.0 * robot_radius + 0.4;  // [m]
  std::vector<TPoint2D> centres;
  for (std::size_t tries = 0; boxes.size() < count; ++tries) {
    if (tries > 2000 * count) {
      throw InvalidMapError("no room for " + std::to_string(count) +
                            " boxes beside which the robot can pass: leave some out (--clutter)");
    }
    const TPoint2D centre = sampler.draw(random);
    const double half = random.uniform(0.15, 0.3), turn = random.uniform(0.0, kPi);
    const double room = passage + half * std::sqrt(2.0);
    if (walls.distance(centre) < room) continue;
    if (std::any_of(centres.begin(), centres.end(), [&](const TPoint2D& other) {
          return (other - centre).norm() < room + 0.3 * std::sqrt(2.0);
        })) {
      continue;
    }
    Polyline box;
    for (int corner = 0; corner <= 4; ++corner) {
      const double angle = turn + 0.5 * kPi * corner;
      box.emplace_back(centre.x + half * std::sqrt(2.0) * std::cos(angle),
                       centre.y + half * std::sqrt(2.0) * std::sin(angle));
    }
    centres.push_back(centre);
    boxes.push_back(std::move(box));
  }
  return boxes;
}

std::vector<Polyline> joined(std::vector<Polyline> a, const std::vector<Polyline>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

World::World(const PolygonMap& map, const SimulatorParams& laser, std::size_t clutter,
             double robot_radius, std::uint64_t seed)
    : map_(map),
      laser_(besideRobot(laser, robot_radius)),
      boxes_([&] {
        Random random(seed ^ 0xb5ad4eceda1ce2a9ULL);
        return placeBoxes(map, clutter, robot_radius, random);
      }()),
      // What stands in free space stops beams as walls beyond do.
      walls_(PolygonMap(map.components(), joined(map.wallsBeyond(), boxes_))) {}

World::World(const PolygonMap& map, const SimulatorParams& laser, const RoomChanges& changes,
             double robot_radius)
    : map_(map), laser_(besideRobot(laser, robot_radius)), walls_(map, changes) {}

std::string World::whyNoRoom(const TPoint2D& place, double radius) const {
  if (!map_.contains(place)) return "it is not in the free space of the map";
  const double room = clearance(place);
  if (room >= radius) return {};
  return "the robot would touch a wall: it is " + std::to_string(room) + " m away";
}

RangeScan World::scan(const mrpt::math::TPose2D& pose, Random& random) const {
  return toRangeScan(simulateScan(walls_, laser_, pose, 0.0, random));
}

mrpt::math::TPose2D World::randomPose(double clearance, Random& random) const {
  const FreeSpaceSampler sampler(map_);
  for (int tries = 0; tries < 20'000; ++tries) {
    const TPoint2D place = sampler.draw(random);
    if (walls_.distance(place) >= clearance) {
      return {place.x, place.y, random.uniform(-kPi, kPi)};
    }
  }
  throw InvalidMapError("no place found in the free space that is " + std::to_string(clearance) +
                        " m from all walls");
}

}  // namespace mrpt_polyloc::apps
