#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A laser and where it is on the robot.
struct POLYLOC_EXPORT LaserMount {
  std::string label = "LASER";
  mrpt::math::TPose2D pose_robot_laser{0, 0, 0};  ///< looks along its x axis [m, rad]
};

/// How a simulated robot is built and moves.
struct POLYLOC_EXPORT DriveSimulatorParams {
  SimulatorParams laser;  ///< of all lasers; the clearance is the robot's
  std::vector<LaserMount> lasers = {LaserMount{}};
  /// From one moment to the next [m]; 0: every moment is somewhere else, and there is no odometry.
  double step = 0.0;
  MotionNoise odometry;

  /// \throws InvalidParamsError naming the bad field, or labels that are not different
  void check() const;
};

/// What a simulated robot sees at one moment.
struct POLYLOC_EXPORT SimulatedMoment {
  StampedPose truth;
  mrpt::math::TPose2D measured{0, 0, 0};  ///< movement since the moment before, by its wheels
  std::vector<mrpt::obs::CObservation2DRangeScan> observations;  ///< one a laser
};

/// Moments of a robot with one laser or several. Without steps as simulateScans(), whose poses
/// these are. With steps one drive: it wanders through the free space, straight ahead while there
/// is room and turning a little, and turns where the clearance ends. A second from one moment to
/// the next. The same seed, map and parameters give the same moments. \throws InvalidParamsError;
/// InvalidMapError as simulateScans(), and if the robot cannot move
POLYLOC_EXPORT std::vector<SimulatedMoment> simulateMoments(const PolygonMap& map,
                                                            const DriveSimulatorParams& params,
                                                            std::size_t count, std::uint64_t seed);

}  // namespace mrpt_polyloc
