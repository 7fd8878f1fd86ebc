#pragma once

#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// What a simulated robot drives through: the map's walls and boxes that the map does not have,
/// all of which stop beams and robots. Ranges and distances by brute force (WallSegments), which
/// share nothing with what the planner predicts.
class World {
 public:
  /// \param laser its noise, and people before it (occluders); they move: anew for each scan
  /// \param clutter boxes, 0.3 to 0.6 m wide, anywhere with room for a robot to pass beside them
  /// \throws InvalidParamsError; InvalidMapError if there is no room for the boxes
  World(const PolygonMap& map, const SimulatorParams& laser, std::size_t clutter,
        double robot_radius, std::uint64_t seed);

  /// \param changes what stands elsewhere than in the map, and stops beams and robots too
  /// \throws InvalidParamsError
  World(const PolygonMap& map, const SimulatorParams& laser, const RoomChanges& changes,
        double robot_radius);

  /// Why a robot of a radius [m] cannot stand at a place; empty if it can.
  std::string whyNoRoom(const TPoint2D& place, double radius) const;

  /// A scan from a pose, the sensor at the robot's origin.
  RangeScan scan(const mrpt::math::TPose2D& pose, Random& random) const;

  /// Distance of a place to the nearest wall or box [m].
  double clearance(const TPoint2D& place) const { return walls_.distance(place); }

  /// A pose anywhere in free space at which the robot keeps so far [m] from everything.
  /// \throws InvalidMapError if there is none
  mrpt::math::TPose2D randomPose(double clearance, Random& random) const;

  const PolygonMap& map() const { return map_; }
  const SimulatorParams& laser() const { return laser_; }
  /// Corners of each box.
  const std::vector<Polyline>& boxes() const { return boxes_; }

 private:
  PolygonMap map_;
  SimulatorParams laser_;
  std::vector<Polyline> boxes_;
  WallSegments walls_;
};

}  // namespace mrpt_polyloc::apps
