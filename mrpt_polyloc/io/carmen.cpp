#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/carmen.h>
#include <mrpt_polyloc/io/carmen_line.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/scan_stream.h>
#include <mrpt_polyloc/io/sensor_labels.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace mrpt_polyloc {

namespace {

using mrpt::math::TPose2D;

constexpr double kMaxSensorOffset = 5.0;  // [m]

/// What the log's PARAM lines say of its lasers.
struct Lasers {
  std::optional<double> resolution;  ///< of the front laser [rad]
  std::optional<double> robot_max;   ///< robot_front_laser_max [m]
  std::optional<double> laser_max;   ///< laser_front_max_range [m]
  double front_offset = 0.0;         ///< [m]
  double rear_offset = 0.0;          ///< [m]

  double maxRange() const { return robot_max.value_or(laser_max.value_or(0.0)); }
};

double positive(const CarmenLine& line, const std::string& what, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) line.fail(what + " is not above 0");
  return value;
}

double readOffset(CarmenLine& line, const std::string& what) {
  const double offset = line.finite(what);
  if (std::abs(offset) > kMaxSensorOffset) line.fail(what + " is above 5 m");
  return offset;
}

void readParam(CarmenLine& line, Lasers& lasers) {
  if (line.fieldCount() < 2) return;
  const std::string name = line.word("name");
  if (name == "laser_front_laser_resolution") {
    lasers.resolution = kDegree * positive(line, name, line.number(name));
  } else if (name == "robot_front_laser_max") {
    lasers.robot_max = positive(line, name, line.number(name));
  } else if (name == "laser_front_max_range") {
    lasers.laser_max = positive(line, name, line.number(name));
  } else if (name == "robot_frontlaser_offset") {
    lasers.front_offset = readOffset(line, name);
  } else if (name == "robot_rearlaser_offset") {
    lasers.rear_offset = readOffset(line, name);
  }
}

struct BeamAngles {
  double first = 0.0;
  double step = 0.0;
};

/// Where the beams of an FLASER line look; the rules are in the header.
BeamAngles flaserAngles(const CarmenLine& line, std::size_t count, const Lasers& lasers,
                        const std::optional<double>& fov) {
  if (count < 2) return {};
  const auto n = static_cast<double>(count);
  if (fov) return {-0.5 * *fov, *fov / (n - 1.0)};
  if (lasers.resolution) {
    const double step = *lasers.resolution;
    const double tolerance = 0.01 * step;
    const double span = (n - 1.0) * step;
    if (span >= 2 * kPi) line.fail("its beams at laser_front_laser_resolution exceed a full turn");
    const bool half_turn = span < kPi + tolerance && span > kPi - step - tolerance;
    return {half_turn ? -0.5 * kPi : -0.5 * span, step};
  }
  if (count == 180 || count == 181) return {-0.5 * kPi, kDegree};
  if (count == 360 || count == 361) return {-0.5 * kPi, 0.5 * kDegree};
  line.fail(line.keyword() + " with " + std::to_string(count) +
            " beams: their field of view is not known, give it by --laser-fov");
}

/// Fields of poses and times behind the lists of numbers.
constexpr std::size_t kFlaserTail = 9;
constexpr std::size_t kRobotLaserTail = 14;
constexpr std::size_t kRawLaserTail = 3;

std::vector<double> readRanges(CarmenLine& line) {
  const std::size_t count = line.count("number of readings");
  if (count > kMaxBeams) line.fail("more than " + std::to_string(kMaxBeams) + " readings");
  std::vector<double> ranges(count);
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

/// Where a laser is whose place the lines do not say: ahead, or behind and looking back.
void place(bool rear, const Lasers& lasers, LoggedScan& scan) {
  scan.sensor = {rear ? lasers.rear_offset : lasers.front_offset, 0.0};
  scan.yaw = rear ? kPi : 0.0;
}

/// A line FLASER or RLASER: its readings and its time. The rest is for finishFlaser(), for PARAM
/// lines count that stand behind it.
LoggedScan readFlaser(CarmenLine& line) {
  LoggedScan scan;
  scan.ranges = readRanges(line);
  line.requireFields(kFlaserTail);
  readPose(line, "laser pose");
  scan.odometry = readPose(line, "odometry pose");
  scan.stamp = readStamp(line);
  return scan;
}

void finishFlaser(const CarmenLine& line, const Lasers& lasers, const std::optional<double>& fov,
                  LoggedScan& scan) {
  const BeamAngles angles = flaserAngles(line, scan.ranges.size(), lasers, fov);
  scan.first = angles.first;
  scan.step = angles.step;
  scan.max_range = lasers.maxRange();
  place(scan.label.front() == 'R', lasers, scan);
}

/// What the lines of newer logs say of beams and readings alike, up to the remissions.
LoggedScan readNewerReadings(CarmenLine& line, std::size_t tail) {
  LoggedScan scan;
  line.finite("laser type");
  scan.first = line.finite("start angle");
  const double fov = line.finite("field of view");
  scan.step = line.finite("angular resolution");
  scan.max_range = line.number("maximum range");
  line.finite("accuracy");
  line.finite("remission mode");
  scan.ranges = readRanges(line);
  const std::size_t remissions = line.count("number of remissions");
  line.requireFields(remissions + tail);
  for (std::size_t i = 0; i < remissions; ++i) line.number("remission", i);
  const std::size_t count = scan.ranges.size();
  if (scan.step == 0.0 && count > 1) scan.step = fov / static_cast<double>(count - 1);
  if (scan.step == 0.0 && count > 1) line.fail("angular resolution and field of view are 0");
  return scan;
}

LoggedScan readRobotLaser(CarmenLine& line) {
  LoggedScan scan = readNewerReadings(line, kRobotLaserTail);
  const TPose2D laser = readPose(line, "laser pose"), robot = readPose(line, "robot pose");
  for (const char* what :
       {"laser tv", "laser rv", "forward safety distance", "side safety distance", "turn axis"}) {
    line.number(what);
  }
  scan.stamp = readStamp(line);
  scan.odometry = robot;
  const double dx = laser.x - robot.x, dy = laser.y - robot.y;
  if (std::hypot(dx, dy) > kMaxSensorOffset) {
    line.fail("the laser is more than 5 m from its robot");
  }
  const double c = std::cos(robot.phi), s = std::sin(robot.phi);
  scan.sensor = {c * dx + s * dy, c * dy - s * dx};
  scan.yaw = std::remainder(laser.phi - robot.phi, 2 * kPi);
  return scan;
}

LoggedScan readRawLaser(CarmenLine& line) {
  LoggedScan scan = readNewerReadings(line, kRawLaserTail);
  scan.stamp = readStamp(line);
  return scan;
}

enum class Kind { none, flaser, raw_laser, robot_laser };

Kind kindOf(const std::string& keyword) {
  if (keyword == "FLASER" || keyword == "RLASER") return Kind::flaser;
  if (keyword == "RAWLASER1" || keyword == "RAWLASER2") return Kind::raw_laser;
  if (keyword == "ROBOTLASER1" || keyword == "ROBOTLASER2") return Kind::robot_laser;
  return Kind::none;
}

/// Lines that tell of the front laser what the others, if they are there, repeat.
bool isFirstChoice(const std::string& keyword) {
  return keyword == "FLASER" || keyword == "ROBOTLASER1";
}

/// Reads a log once, giving its scans away as they come; what the whole log says of them is known
/// in the end.
class CarmenReader {
 public:
  CarmenReader(std::string path, const ScanFileOptions& options)
      : path_(std::move(path)), options_(options) {}

  void read(Notes* notes, const TakeLoggedScan& take) {
    using AtCut = GzInputStream::AtCut;
    GzInputStream stream(path_, options_.strict ? AtCut::refuse : AtCut::end);
    std::string cut = stream.cut(), text;
    for (std::size_t number = 1; stream.readLine(text); ++number) {
      CarmenLine line(path_, number, text);
      try {
        add(line, number, take);
      } catch (const FormatError&) {
        // Only the end of a file can be missing.
        if (options_.strict || stream.lineHadEnd() || labels_.empty()) throw;
        if (cut.empty()) cut = "line " + std::to_string(number) + ": it ends inside the line";
      }
    }
    if (!cut.empty()) {
      addNote(notes, "it is cut short (" + cut + "): the " + std::to_string(labels_.size()) +
                         " scans before that are used (--strict refuses it)");
    }
  }

  /// Those scans, by their numbers, that are of the sensor and do not only repeat others.
  std::vector<std::size_t> rows() const {
    const bool has_first_choice = std::any_of(labels_.begin(), labels_.end(), isFirstChoice);
    std::vector<std::size_t> kept;
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const bool is_repetition = has_first_choice && !isFirstChoice(labels_[i]) &&
                                 !isAskedFor(labels_[i], options_.sensor_label);
      if (is_repetition) continue;
      kept.push_back(i);
      labels.push_back(labels_[i]);
    }
    std::vector<std::size_t> rows;
    for (const std::size_t i : selectSensor(path_, labels, options_.sensor_label)) {
      rows.push_back(kept[i]);
    }
    return rows;
  }

  /// Takes in what the PARAM lines of the whole log say. \param number of the scan
  void finish(std::size_t number, LoggedScan& scan) const {
    const Kind kind = kindOf(scan.label);
    if (kind == Kind::flaser) {
      const CarmenLine line(path_, numbers_[number], scan.label);
      finishFlaser(line, lasers_, options_.laser_fov, scan);
    } else if (kind == Kind::raw_laser) {
      place(scan.label.back() == '2', lasers_, scan);
    }
  }

 private:
  bool isWanted(const std::string& keyword) {
    if (!options_.sensor_label.empty() && isAskedFor(keyword, options_.sensor_label)) return true;
    if (isFirstChoice(keyword)) {
      has_first_choice_ = true;
      return true;
    }
    return !has_first_choice_;
  }

  void add(CarmenLine& line, std::size_t number, const TakeLoggedScan& take) {
    const std::string& keyword = line.keyword();
    if (keyword == "PARAM") return readParam(line, lasers_);
    const Kind kind = kindOf(keyword);
    if (kind == Kind::none || !isWanted(keyword)) return;
    LoggedScan scan = kind == Kind::flaser      ? readFlaser(line)
                      : kind == Kind::raw_laser ? readRawLaser(line)
                                                : readRobotLaser(line);
    scan.label = keyword;
    scan.place = "line " + std::to_string(number);
    labels_.push_back(keyword);
    numbers_.push_back(number);
    requireScans(path_, scan.place, labels_.size(), options_.max_scans);
    take(std::move(scan));
  }

  std::string path_;
  ScanFileOptions options_;
  Lasers lasers_;
  bool has_first_choice_ = false;
  std::vector<std::string> labels_;   ///< of the scans
  std::vector<std::size_t> numbers_;  ///< of their lines
};

}  // namespace

std::vector<LoggedScan> loadLoggedCarmen(const std::string& path, const ScanFileOptions& options,
                                         Notes* notes) {
  std::vector<LoggedScan> scans;
  const ScanStreamEnd end = streamCarmen(
      path, options, notes, [&](LoggedScan scan) { scans.push_back(std::move(scan)); });
  std::vector<LoggedScan> selected;
  for (const std::size_t i : end.rows) {
    end.finish(i, scans[i]);
    selected.push_back(std::move(scans[i]));
  }
  return selected;
}

std::vector<RangeScan> loadCarmen(const std::string& path, const ScanFileOptions& options,
                                  Notes* notes) {
  return toRangeScans(path, loadLoggedCarmen(path, options, notes), options.readings, notes);
}

ScanStreamEnd streamCarmen(const std::string& path, const ScanFileOptions& options, Notes* notes,
                           const TakeLoggedScan& take) {
  const auto& fov = options.laser_fov;
  if (fov && !(*fov > 0.0 && *fov <= 2 * kPi + 1e-9)) {
    throw InvalidParamsError("laser_fov is " + formatted("%f", *fov) + ", not in (0, 2 pi]");
  }
  const auto reader = std::make_shared<CarmenReader>(path, options);
  reader->read(notes, take);
  return {reader->rows(),
          [reader](std::size_t number, LoggedScan& scan) { reader->finish(number, scan); }};
}

}  // namespace mrpt_polyloc
