#pragma once

#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/ChangedWorld.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// The sensor, its noise, and what stands in its way that is not in the map.
struct POLYLOC_EXPORT SimulatorParams {
  std::size_t beams = 360;  ///< one a degree: the usual small lidar
  /// Field of view, centred on the robot's heading [rad]. The whole circle: the beams divide it
  /// evenly and the first direction is not repeated; less: the outer beams lie on its rim.
  double fov = 6.283185307179586;
  double sigma = 0.03;       ///< standard deviation of a range [m]: a small lidar's
  double max_range = 20.0;   ///< [m]; nothing met within: a no-return
  double dropout = 0.0;      ///< probability that a beam becomes a no-return (glass, black paint)
  double short_beams = 0.0;  ///< probability that a beam is cut to a uniformly random shorter range
  /// Objects in front of the robot: each covers a contiguous sector of 8 to 19 degrees anywhere in
  /// the field of view, at 20 to 90 % of the range of the sector's middle.
  std::size_t occluders = 0;
  double nearest_occluder = 0.0;  ///< they stand no nearer than this [m]: not in the robot
  double clearance = 0.3;  ///< least distance of the robot's centre to a wall [m]: a small robot's
  /// In what the world that is seen differs from the map, in which truths are told. Drawn from the
  /// seed as well, without altering poses.
  WorldChanges world;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// One simulated scan and where it was taken.
struct POLYLOC_EXPORT SimulatedScan {
  StampedPose truth;
  mrpt::obs::CObservation2DRangeScan observation;
};

/// One scan from a pose, which may lie anywhere, of the walls that the room has now. The sensor
/// sits at the robot's origin. \throws InvalidParamsError
POLYLOC_EXPORT mrpt::obs::CObservation2DRangeScan simulateScan(
    const WallSegments& walls, const SimulatorParams& params,
    const mrpt::math::TPose2D& pose_map_robot, std::uint64_t seed);

/// `count` scans at random poses: uniform over the free space (by area) that keeps the clearance,
/// headings uniform. The sensor sits at the robot's origin; stamps are synthetic, 1e9 s + row.
///
/// Ranges by brute force over all walls (see ChangedWorld). The same seed, map and parameters give
/// the same scans, whatever the standard library; poses depend on seed, map and clearance only, so
/// that noise can be compared at equal poses.
/// \throws InvalidParamsError; InvalidMapError if no place that keeps the clearance was found.
POLYLOC_EXPORT std::vector<SimulatedScan> simulateScans(const PolygonMap& map,
                                                        const SimulatorParams& params,
                                                        std::size_t count, std::uint64_t seed);

/// The same with noise that goes on from scan to scan; parameters are not checked.
POLYLOC_EXPORT mrpt::obs::CObservation2DRangeScan simulateScan(
    const WallSegments& walls, const SimulatorParams& params,
    const mrpt::math::TPose2D& pose_map_laser, double stamp, Random& noise);

/// What the laser sees from a pose of it in the map, the clearance being the robot's.
POLYLOC_EXPORT mrpt::obs::CObservation2DRangeScan simulateScan(
    const ChangedWorld& world, const SimulatorParams& params,
    const mrpt::math::TPose2D& pose_map_laser, double stamp, Random& noise);

}  // namespace mrpt_polyloc
