#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What one beam says: it hit something at its range; nothing was hit within its range (the
/// sensor's maximum); or it carries no information.
enum class BeamKind : std::uint8_t { hit, no_return, invalid };

/// One beam of a scan.
struct POLYLOC_EXPORT Beam {
  double bearing = 0.0;  ///< direction in the ROBOT frame (the sensor's yaw is included) [rad]
  double range = 0.0;    ///< from the sensor [m]; for no_return the maximum range; 0 if invalid
  BeamKind kind = BeamKind::invalid;
};

/// One planar scan: beams that start at the sensor, whose place on the robot is known.
///
/// Any field of view, any spacing, any order. Immutable.
class POLYLOC_EXPORT RangeScan {
 public:
  /// \param beams in the robot frame, see Beam
  /// \param sensor position of the beams' common origin in the robot frame [m]
  /// \param stamp seconds since 1970-01-01
  /// \param label of the sensor, to tell several lasers apart
  /// A hit or no_return whose bearing or range is not finite (the range in single precision), or
  /// whose range is not positive, becomes invalid: a defined result for what sensors send.
  /// \throws InvalidParamsError if the sensor's position is not finite: no pose could be told
  RangeScan(std::vector<Beam> beams, const mrpt::math::TPoint2D& sensor = {0, 0},
            double stamp = 0.0, std::string label = {});

  const std::vector<Beam>& beams() const { return beams_; }
  const mrpt::math::TPoint2D& sensor() const { return sensor_; }
  double stamp() const { return stamp_; }
  const std::string& label() const { return label_; }

  std::size_t hitCount() const { return hit_count_; }
  std::size_t noReturnCount() const { return no_return_count_; }

  /// The robot's pose in the map, given the pose of the *beam frame* there: its origin at the
  /// sensor, its axes parallel to the robot's.
  mrpt::math::TPose2D robotFromBeamFrame(const mrpt::math::TPose2D& pose_map_beams) const;
  /// The inverse of robotFromBeamFrame().
  mrpt::math::TPose2D beamFrameFromRobot(const mrpt::math::TPose2D& pose_map_robot) const;

 private:
  std::vector<Beam> beams_;
  mrpt::math::TPoint2D sensor_;
  double stamp_;
  std::string label_;
  std::size_t hit_count_ = 0;
  std::size_t no_return_count_ = 0;
};

}  // namespace mrpt_polyloc
