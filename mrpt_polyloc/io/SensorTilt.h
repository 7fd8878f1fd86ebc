#pragma once

namespace mrpt_polyloc {

/// Tilts from here on are worth a note [rad]: 2 degrees, at which a range of 10 m is 6 mm off.
constexpr double kNotedTilt = 0.034906585039886592;

/// How a laser that is not level sees: its beams in the robot frame, projected to the floor.
///
/// The orientation is MRPT's, R = Rz(yaw) Ry(pitch) Rx(roll). A beam of bearing a looks along
/// d = R (cos a, sin a, 0): seen from above its bearing is that of (dx, dy), and its range counts
/// by its share in the plane, |(dx, dy)|. A roll of 180 degrees, a laser upside down, mirrors the
/// bearings and costs nothing.
///
/// The rule for what is refused: walls are upright, the floor is not. A beam that points down meets
/// the floor at height / -dz. A reading at 95 % of that or beyond says nothing. A sensor is refused
/// if it is tilted by more than 10 degrees, or if the steepest of its beams meets the floor within
/// 3 m: then much of what it sees is floor. The height is that of the sensor above the robot's
/// origin; where that says nothing (2 cm or less, for many logs hold 0) 0.3 m is assumed for the
/// refusal, which makes it 5.7 degrees, and no reading is taken for the floor.
class SensorTilt {
 public:
  /// \param height of the sensor above the robot's origin [m]
  SensorTilt(double yaw, double pitch, double roll, double height);

  /// Between the sensor's plane and the floor, 0 to pi / 2 [rad].
  double angle() const { return angle_; }
  /// Whether bearings and ranges need no projection: level to 1e-9 rad, maybe upside down.
  bool isLevel() const { return level_; }
  bool isUpsideDown() const { return upside_down_; }

  /// A beam seen from above.
  struct Projection {
    double bearing = 0.0;      ///< in the robot frame [rad]
    double scale = 1.0;        ///< of its range
    double floor_range = 0.0;  ///< where it meets the floor, unscaled [m]; infinite if it does not
  };
  /// \param bearing in the sensor's frame [rad]
  Projection project(double bearing) const;

  /// Readings at or beyond this say nothing for a beam, for they may be of the floor; infinite if
  /// the height is not known.
  double greatestReading(const Projection& beam) const;

  /// Whether a sensor whose steepest beam meets the floor there is refused.
  bool isRefused(double nearest_floor_range) const;

 private:
  double yaw_;
  double row_[3][2];  ///< of R, as far as beams in the sensor's plane need it
  double height_;     ///< known or assumed [m]
  bool height_known_;
  double angle_;
  bool level_, upside_down_;
};

}  // namespace mrpt_polyloc
