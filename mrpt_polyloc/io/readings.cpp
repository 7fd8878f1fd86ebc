#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/SensorTilt.h>
#include <mrpt_polyloc/io/readings.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {

Beam readingToBeam(double bearing, double range, bool valid, const ReadingLimits& limits) {
  if (std::isnan(range) || range <= 0.0) return {};
  const bool limited = std::isfinite(limits.max_range) && limits.max_range > 0.0;
  if (limited && range >= kNoReturnShare * limits.max_range) {
    return {bearing, limits.max_range, BeamKind::no_return};
  }
  if (!valid || std::isinf(range) || range < limits.min_range) return {};
  return {bearing, range, BeamKind::hit};
}

namespace {

[[noreturn]] void refuseTilt(const LoggedScan& scan, const SensorTilt& tilt, double floor_range) {
  std::string reason =
      "scan of sensor '" + scan.label + "': " +
      formatted("it is tilted by %g deg (pitch %g, roll %g)", toDegrees(tilt.angle()),
                toDegrees(scan.pitch), toDegrees(scan.roll));
  if (std::isfinite(floor_range)) {
    reason += formatted(", so that its beams meet the floor %g m ahead", floor_range);
  }
  throw std::invalid_argument(
      reason + ": at most 10 deg, and no floor within 3 m, can be projected to a plane");
}

/// The beams of a sensor that is not level.
std::vector<Beam> projectedBeams(const LoggedScan& scan, const SensorTilt& tilt,
                                 const ReadingLimits& limits) {
  std::vector<Beam> beams(scan.ranges.size());
  double nearest_floor = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const auto seen = tilt.project(scan.first + static_cast<double>(i) * scan.step);
    nearest_floor = std::min(nearest_floor, seen.floor_range);
    const double reach =
        limits.max_range > 0.0 ? std::min(scan.ranges[i], limits.max_range) : scan.ranges[i];
    if (reach >= tilt.greatestReading(seen) && std::isfinite(reach)) continue;
    beams[i] = readingToBeam(seen.bearing, scan.ranges[i], scan.isValid(i), limits);
    beams[i].range *= seen.scale;
  }
  if (tilt.isRefused(nearest_floor)) refuseTilt(scan, tilt, nearest_floor);
  return beams;
}

}  // namespace

RangeScan toRangeScan(const LoggedScan& scan, const ReadingLimits& limits,
                      const std::vector<bool>& robot_beams) {
  const SensorTilt tilt(scan.yaw, scan.pitch, scan.roll, scan.height);
  std::vector<Beam> beams;
  if (tilt.isLevel()) {
    const double turn = tilt.isUpsideDown() ? -1.0 : 1.0;
    const double first = tilt.project(scan.first).bearing;
    beams.resize(scan.ranges.size());
    for (std::size_t i = 0; i < beams.size(); ++i) {
      beams[i] = readingToBeam(first + static_cast<double>(i) * turn * scan.step, scan.ranges[i],
                               scan.isValid(i), limits);
    }
  } else {
    beams = projectedBeams(scan, tilt, limits);
  }
  for (std::size_t i = 0; i < std::min(beams.size(), robot_beams.size()); ++i) {
    if (robot_beams[i]) beams[i] = Beam{};
  }
  return RangeScan(std::move(beams), scan.sensor, scan.stamp, scan.label);
}

}  // namespace mrpt_polyloc
