#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/carmen.h>
#include <mrpt_polyloc/io/carmen_line.h>
#include <mrpt_polyloc/io/readings.h>
#include <mrpt_polyloc/io/sensor_labels.h>

#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace mrpt_polyloc {

namespace {

using mrpt::math::TPose2D;

constexpr double kDefaultMaxRange = 80.0;  // [m]
constexpr double kMaxSensorOffset = 5.0;   // [m]

/// What the log's PARAM lines say of its front laser.
struct FrontLaser {
  std::optional<double> resolution;  ///< [rad]
  std::optional<double> robot_max;   ///< robot_front_laser_max [m]
  std::optional<double> laser_max;   ///< laser_front_max_range [m]
  double offset = 0.0;               ///< [m]

  double maxRange() const { return robot_max.value_or(laser_max.value_or(kDefaultMaxRange)); }
};

double positive(const CarmenLine& line, const std::string& what, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) line.fail(what + " is not above 0");
  return value;
}

/// Collects the PARAM lines of the whole log.
FrontLaser readFrontLaser(const std::string& path) {
  FrontLaser laser;
  GzInputStream stream(path);
  std::string text;
  for (std::size_t number = 1; stream.readLine(text); ++number) {
    CarmenLine line(path, number, text);
    if (line.keyword() != "PARAM" || line.fieldCount() < 2) continue;
    const std::string name = line.word("name");
    if (name == "laser_front_laser_resolution") {
      laser.resolution = kDegree * positive(line, name, line.number(name));
    } else if (name == "robot_front_laser_max") {
      laser.robot_max = positive(line, name, line.number(name));
    } else if (name == "laser_front_max_range") {
      laser.laser_max = positive(line, name, line.number(name));
    } else if (name == "robot_frontlaser_offset") {
      laser.offset = line.finite(name);
      if (std::abs(laser.offset) > kMaxSensorOffset) line.fail(name + " is above 5 m");
    }
  }
  return laser;
}

struct BeamAngles {
  double first = 0.0;
  double step = 0.0;
};

/// Where the beams of an FLASER line look; the rules are in the header.
BeamAngles flaserAngles(const CarmenLine& line, std::size_t count, const FrontLaser& laser,
                        const std::optional<double>& fov) {
  if (count < 2) return {};
  const auto n = static_cast<double>(count);
  if (fov) return {-0.5 * *fov, *fov / (n - 1.0)};
  if (laser.resolution) {
    const double step = *laser.resolution;
    const double tolerance = 0.01 * step;
    const double span = (n - 1.0) * step;
    if (span >= 2 * kPi) line.fail("its beams at laser_front_laser_resolution exceed a full turn");
    const bool half_turn = span < kPi + tolerance && span > kPi - step - tolerance;
    return {half_turn ? -0.5 * kPi : -0.5 * span, step};
  }
  if (count == 180 || count == 181) return {-0.5 * kPi, kDegree};
  if (count == 360 || count == 361) return {-0.5 * kPi, 0.5 * kDegree};
  line.fail("FLASER with " + std::to_string(count) +
            " beams: their field of view is not known, give it by --laser-fov");
}

/// Fields of poses and times behind the lists of numbers.
constexpr std::size_t kFlaserTail = 9;
constexpr std::size_t kRobotLaserTail = 14;

std::vector<double> readRanges(CarmenLine& line) {
  std::vector<double> ranges(line.count("number of readings"));
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    ranges[i] = line.number("reading", i);
  }
  return ranges;
}

TPose2D readPose(CarmenLine& line, const std::string& what) {
  const double x = line.finite(what), y = line.finite(what), phi = line.finite(what);
  return {x, y, phi};
}

/// The end of every message line: its own time, the host, the logger's time.
double readStamp(CarmenLine& line) {
  const double ipc = line.finite("ipc timestamp");
  line.word("host");
  const double logger = line.finite("logger timestamp");
  return ipc != 0.0 ? ipc : logger;
}

RangeScan makeScan(const std::vector<double>& ranges, const BeamAngles& angles, double max_range,
                   const mrpt::math::TPoint2D& sensor, double stamp, const std::string& label) {
  std::vector<Beam> beams(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    beams[i] = readingToBeam(angles.first + static_cast<double>(i) * angles.step, ranges[i], true,
                             max_range);
  }
  return RangeScan(std::move(beams), sensor, stamp, label);
}

RangeScan readFlaser(CarmenLine& line, const FrontLaser& laser, const std::optional<double>& fov) {
  const std::vector<double> ranges = readRanges(line);
  line.requireFields(kFlaserTail);
  readPose(line, "laser pose");
  readPose(line, "odometry pose");
  const double stamp = readStamp(line);
  return makeScan(ranges, flaserAngles(line, ranges.size(), laser, fov), laser.maxRange(),
                  {laser.offset, 0.0}, stamp, line.keyword());
}

RangeScan readRobotLaser(CarmenLine& line) {
  line.finite("laser type");
  const double start = line.finite("start angle");
  const double fov = line.finite("field of view");
  double step = line.finite("angular resolution");
  const double stated_max = line.number("maximum range");
  line.finite("accuracy");
  line.finite("remission mode");
  const std::vector<double> ranges = readRanges(line);
  const std::size_t remissions = line.count("number of remissions");
  line.requireFields(remissions + kRobotLaserTail);
  for (std::size_t i = 0; i < remissions; ++i) line.number("remission", i);
  const TPose2D laser = readPose(line, "laser pose"), robot = readPose(line, "robot pose");
  for (const char* what :
       {"laser tv", "laser rv", "forward safety distance", "side safety distance", "turn axis"}) {
    line.number(what);
  }
  const double stamp = readStamp(line);

  if (step == 0.0 && ranges.size() > 1) step = fov / static_cast<double>(ranges.size() - 1);
  if (step == 0.0 && ranges.size() > 1) line.fail("angular resolution and field of view are 0");
  const double dx = laser.x - robot.x, dy = laser.y - robot.y;
  if (std::hypot(dx, dy) > kMaxSensorOffset) {
    line.fail("the laser is more than 5 m from its robot");
  }
  const double c = std::cos(robot.phi), s = std::sin(robot.phi);
  const double max_range =
      std::isfinite(stated_max) && stated_max > 0.0 ? stated_max : kDefaultMaxRange;
  return makeScan(ranges, {start + std::remainder(laser.phi - robot.phi, 2 * kPi), step}, max_range,
                  {c * dx + s * dy, c * dy - s * dx}, stamp, line.keyword());
}

}  // namespace

std::vector<RangeScan> loadCarmen(const std::string& path, const ScanFileOptions& options) {
  const auto& fov = options.laser_fov;
  if (fov && !(*fov > 0.0 && *fov <= 2 * kPi + 1e-9)) {
    throw InvalidParamsError("laser_fov is " + std::to_string(*fov) + ", not in (0, 2 pi]");
  }
  const FrontLaser laser = readFrontLaser(path);
  std::vector<RangeScan> scans;
  std::vector<std::string> labels;
  GzInputStream stream(path);
  std::string text;
  for (std::size_t number = 1; stream.readLine(text); ++number) {
    CarmenLine line(path, number, text);
    if (line.keyword() == "FLASER") {
      scans.push_back(readFlaser(line, laser, fov));
    } else if (line.keyword() == "ROBOTLASER1") {
      scans.push_back(readRobotLaser(line));
    } else {
      continue;
    }
    labels.push_back(line.keyword());
  }

  std::vector<RangeScan> selected;
  for (const std::size_t i : selectSensor(path, labels, options.sensor_label)) {
    selected.push_back(std::move(scans[i]));
  }
  return selected;
}

}  // namespace mrpt_polyloc
