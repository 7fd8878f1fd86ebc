#include "World.h"

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

std::vector<double> bearingsOf(const SimulatorParams& laser) {
  const bool is_full = laser.fov > kTwoPi - 1e-9;
  const auto beams = static_cast<double>(laser.beams);
  const double aperture = is_full ? laser.fov * (beams - 1.0) / beams : laser.fov;
  std::vector<double> bearings(laser.beams, 0.0);
  for (std::size_t i = 0; i < laser.beams && laser.beams > 1; ++i) {
    bearings[i] = aperture * (static_cast<double>(i) / (beams - 1.0) - 0.5);
  }
  return bearings;
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
      laser_((laser.check(), laser)),
      robot_radius_(robot_radius),
      bearings_(bearingsOf(laser)),
      boxes_([&] {
        Random random(seed ^ 0xb5ad4eceda1ce2a9ULL);
        return placeBoxes(map, clutter, robot_radius, random);
      }()),
      // What stands in free space stops beams as walls beyond do.
      walls_(PolygonMap(map.components(), joined(map.wallsBeyond(), boxes_))) {}

void World::occlude(std::vector<double>& ranges, Random& random) const {
  const std::vector<double> clear = ranges;
  for (std::size_t k = 0; k < laser_.occluders; ++k) {
    const double half_width = 0.5 * random.uniform(8.0, 19.0) * kDegree;
    const double middle = random.uniform(-0.5, 0.5) * laser_.fov;
    const double fraction = random.uniform(0.2, 0.9);
    const auto apart = [&](std::size_t i) { return angleBetween(bearings_[i], middle); };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < bearings_.size(); ++i) {
      if (apart(i) < apart(nearest)) nearest = i;
    }
    // People do not stand in the robot.
    const double person =
        std::max(fraction * std::min(clear[nearest], laser_.max_range), robot_radius_ + 0.15);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (apart(i) <= half_width) ranges[i] = std::min(ranges[i], person);
    }
  }
}

RangeScan World::scan(const mrpt::math::TPose2D& pose, Random& random) const {
  std::vector<double> ranges;
  for (const double bearing : bearings_) {
    ranges.push_back(walls_.range({pose.x, pose.y}, pose.phi + bearing));
  }
  occlude(ranges, random);
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double noise = laser_.sigma * random.normal();
    const bool is_short = random.unit() < laser_.short_beams;
    const double fraction = random.unit();
    const bool is_lost = random.unit() < laser_.dropout;
    double range = ranges[i];
    if (is_short) range = fraction * std::min(range, laser_.max_range);
    const bool is_hit = !is_lost && range + noise < laser_.max_range;
    beams.push_back({bearings_[i], is_hit ? std::max(range + noise, 0.001) : laser_.max_range,
                     is_hit ? BeamKind::hit : BeamKind::no_return});
  }
  return RangeScan(std::move(beams));
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
