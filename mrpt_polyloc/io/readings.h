#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Readings from this share of the maximum range on are no-returns: drivers state 30 m and send
/// 29.96 where nothing came back, simulators stay some hundredths below.
constexpr double kNoReturnShare = 0.98;

/// Which readings of a sensor are measurements.
struct POLYLOC_EXPORT ReadingLimits {
  double max_range = 0.0;  ///< [m]; not positive or not finite: not known
  double min_range = 0.0;  ///< hits nearer than this say nothing [m]
};

/// What a laser's reading says, in one way for all kinds of logs and with REP 117's meanings.
///
/// - +infinity: nothing within the maximum range, a no-return; nothing where that is not known.
/// - NaN, 0, negative, -infinity: nothing is known.
/// - At or above kNoReturnShare of the maximum range: a no-return.
/// - Else, flagged not valid: nothing is known. MRPT's filters of angles and areas set the flag of
///   what they mask and keep its range, which is no proof of free space.
/// - Nearer than `min_range`: nothing is known.
/// - Else a hit.
/// \param bearing in the robot frame [rad]
/// \return the beam; the range of a no-return is the maximum range
POLYLOC_EXPORT Beam readingToBeam(double bearing, double range, bool valid,
                                  const ReadingLimits& limits);

/// A scan as a log holds it, before it is known what its readings say.
struct POLYLOC_EXPORT LoggedScan {
  std::vector<double> ranges;                 ///< as read [m]
  std::vector<unsigned char> flags;           ///< whether each is flagged valid; empty: all are
  double max_range = 0.0;                     ///< as stated [m]; not positive or not finite: unsaid
  double first = 0.0, step = 0.0;             ///< bearings in the sensor's frame [rad]
  double yaw = 0.0, pitch = 0.0, roll = 0.0;  ///< of the sensor on the robot [rad]
  mrpt::math::TPoint2D sensor{0, 0};          ///< where it is on the robot [m]
  double height = 0.0;                        ///< of the sensor above the robot's origin [m]
  double stamp = 0.0;                         ///< [s]
  std::string label;
  std::string place;  ///< in its file, for messages
  /// Of the robot by its wheels, in a frame of their own [m, rad]; none if the log does not say.
  std::optional<mrpt::math::TPose2D> odometry;

  bool isValid(std::size_t i) const { return flags.empty() || flags[i] != 0; }
};

/// What is asked of the readings of a file, whatever it says itself.
struct POLYLOC_EXPORT ReadingOptions {
  /// Maximum range of the sensor [m]; not given: what the file says, or shows (see surveySensor()).
  std::optional<double> max_range;
  /// Hits nearer than this say nothing [m]; not given: the beams that see the robot itself say
  /// nothing (see surveySensor()).
  std::optional<double> min_range;

  /// \throws InvalidParamsError naming the bad field: not positive and finite, min_range not below
  /// max_range
  void check() const;
};

/// The scan that a log's readings are, projected to the floor (see SensorTilt).
/// \param robot_beams by index, whether a beam sees the robot itself and says nothing; may be empty
/// \throws std::invalid_argument naming the sensor, if its tilt is refused
POLYLOC_EXPORT RangeScan toRangeScan(const LoggedScan& scan, const ReadingLimits& limits,
                                     const std::vector<bool>& robot_beams = {});

}  // namespace mrpt_polyloc
