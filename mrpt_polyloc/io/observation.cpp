#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/readings.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

namespace {

constexpr double kBearingTolerance = 1e-6;  // [rad], of evenly spread beams

[[noreturn]] void refuse(const mrpt::obs::CObservation2DRangeScan& observation,
                         const std::string& reason) {
  throw std::invalid_argument("scan of sensor '" + observation.sensorLabel + "': " + reason);
}

void requireFinitePose(const mrpt::obs::CObservation2DRangeScan& observation) {
  const auto& pose = observation.sensorPose;
  for (const double value : {pose.x(), pose.y(), pose.z(), pose.yaw(), pose.pitch(), pose.roll()}) {
    if (!std::isfinite(value)) refuse(observation, "the sensor's pose is not finite");
  }
}

void requireMaxRange(double max_range) {
  if (!std::isfinite(max_range) || max_range <= 0.0) {
    throw std::invalid_argument("toObservation: max_range is not positive");
  }
}

/// A scan's observation of so many beams before anything is known of them.
mrpt::obs::CObservation2DRangeScan blankObservation(const RangeScan& scan, std::size_t beams,
                                                    double aperture, double yaw, double max_range) {
  mrpt::obs::CObservation2DRangeScan observation;
  observation.aperture = static_cast<float>(aperture);
  observation.maxRange = static_cast<float>(max_range);
  observation.rightToLeft = true;
  observation.sensorLabel = scan.label();
  observation.sensorPose = mrpt::poses::CPose3D(scan.sensor().x, scan.sensor().y, 0, yaw, 0, 0);
  observation.timestamp = mrpt::Clock::fromDouble(scan.stamp());
  observation.resizeScanAndAssign(beams, 0.0F, false);
  return observation;
}

void putReading(const Beam& beam, std::size_t place, double max_range,
                mrpt::obs::CObservation2DRangeScan& observation) {
  const bool hit = beam.kind == BeamKind::hit && beam.range < max_range;
  observation.setScanRange(place, static_cast<float>(hit ? beam.range : max_range));
  observation.setScanRangeValidity(place, hit);
}

/// The middle one of the spacings of beams in rising order; beams on one another count once.
double middleSpacing(const std::vector<Beam>& beams) {
  constexpr double kFinest = 0.01 * kDegree, kOfOneBeam = kDegree;
  std::vector<double> spacings;
  for (std::size_t i = 1; i < beams.size(); ++i) {
    const double spacing = beams[i].bearing - beams[i - 1].bearing;
    if (spacing > kFinest) spacings.push_back(spacing);
  }
  if (spacings.empty()) return kOfOneBeam;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

}  // namespace

bool rightToLeft(const mrpt::obs::CObservation2DRangeScan& observation) {
  unsigned char byte = 0;
  static_assert(sizeof(observation.rightToLeft) == sizeof(byte));
  std::memcpy(&byte, &observation.rightToLeft, sizeof(byte));
  return byte != 0;
}

LoggedScan toLoggedScan(const mrpt::obs::CObservation2DRangeScan& observation) {
  requireFinitePose(observation);
  const double aperture = static_cast<double>(observation.aperture);
  if (!std::isfinite(aperture) || aperture < 0.0) {
    refuse(observation, "its aperture is negative or not finite");
  }
  const std::size_t count = observation.getScanSize();
  if (count > kMaxBeams) {
    refuse(observation, "more than " + std::to_string(kMaxBeams) + " beams");
  }
  const double sweep = rightToLeft(observation) ? aperture : -aperture;

  LoggedScan scan;
  scan.step = count > 1 ? sweep / static_cast<double>(count - 1) : 0.0;
  scan.first = count > 1 ? -0.5 * sweep : 0.0;
  if (count > 0) {  // not one by one: MRPT checks each index
    const float* const ranges = &observation.getScanRange(0);
    scan.ranges.assign(ranges, ranges + count);
  }
  scan.flags.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    scan.flags[i] = observation.getScanRangeValidity(i) ? 1 : 0;
  }
  scan.max_range = static_cast<double>(observation.maxRange);
  const auto& pose = observation.sensorPose;
  scan.yaw = pose.yaw(), scan.pitch = pose.pitch(), scan.roll = pose.roll();
  scan.sensor = {pose.x(), pose.y()};
  scan.height = pose.z();
  scan.stamp = observation.timestamp == INVALID_TIMESTAMP
                   ? 0.0
                   : mrpt::Clock::toDouble(observation.timestamp);
  scan.label = observation.sensorLabel;
  return scan;
}

RangeScan toRangeScan(const mrpt::obs::CObservation2DRangeScan& observation) {
  return toRangeScan(toLoggedScan(observation), {static_cast<double>(observation.maxRange), 0.0});
}

void applyFacts(const SensorFacts& facts, mrpt::obs::CObservation2DRangeScan& observation) {
  if (facts.limits.max_range > 0.0) {
    observation.maxRange = static_cast<float>(facts.limits.max_range);
  }
  for (std::size_t i = 0; i < observation.getScanSize(); ++i) {
    const bool sees_robot = i < facts.robot_beams.size() && facts.robot_beams[i];
    const auto range = static_cast<double>(observation.getScanRange(i));
    if (!sees_robot && !(range < facts.limits.min_range)) continue;
    observation.setScanRange(i, 0.0F);
    observation.setScanRangeValidity(i, false);
  }
}

mrpt::obs::CObservation2DRangeScan toObservation(const RangeScan& scan, double aperture, double yaw,
                                                 double max_range) {
  if (!std::isfinite(aperture) || aperture < 0.0 || !std::isfinite(yaw)) {
    throw std::invalid_argument("toObservation: aperture or yaw is negative or not finite");
  }
  requireMaxRange(max_range);
  const auto& beams = scan.beams();
  const double step = beams.size() > 1 ? aperture / static_cast<double>(beams.size() - 1) : 0.0;
  const double first = yaw - (beams.size() > 1 ? 0.5 * aperture : 0.0);

  mrpt::obs::CObservation2DRangeScan observation =
      blankObservation(scan, beams.size(), aperture, yaw, max_range);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind == BeamKind::invalid) continue;
    const double bearing = first + static_cast<double>(i) * step;
    if (std::abs(std::remainder(beams[i].bearing - bearing, 2 * kPi)) > kBearingTolerance) {
      throw std::invalid_argument("toObservation: beam " + std::to_string(i) +
                                  " is not where evenly spread beams would have it");
    }
    putReading(beams[i], i, max_range, observation);
  }
  return observation;
}

mrpt::obs::CObservation2DRangeScan toEvenObservation(const RangeScan& scan, double max_range) {
  requireMaxRange(max_range);
  std::vector<Beam> beams;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::invalid) beams.push_back(beam);
  }
  if (beams.empty()) return blankObservation(scan, 0, 0.0, 0.0, max_range);
  const auto is_before = [](const Beam& a, const Beam& b) { return a.bearing < b.bearing; };
  std::stable_sort(beams.begin(), beams.end(), is_before);
  const double step = middleSpacing(beams), first = beams.front().bearing;
  const auto placeOf = [&](const Beam& beam) {
    return static_cast<std::size_t>(std::lround((beam.bearing - first) / step));
  };
  const std::size_t last = placeOf(beams.back());
  const double aperture = step * static_cast<double>(last);
  mrpt::obs::CObservation2DRangeScan observation =
      blankObservation(scan, last + 1, aperture, first + 0.5 * aperture, max_range);
  for (const Beam& beam : beams) {
    const std::size_t place = placeOf(beam);
    if (beam.kind != BeamKind::hit && observation.getScanRangeValidity(place)) continue;
    putReading(beam, place, max_range, observation);
  }
  return observation;
}

}  // namespace mrpt_polyloc
