#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/carmen.h>
#include <mrpt_polyloc/io/drive_log.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/limits.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/sensor_labels.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::serialization::CSerializable;

/// What wheels said at some time.
struct OdometryReading {
  double stamp = 0.0;  ///< [s]; 0: not known
  TPose2D pose{0, 0, 0};
};

/// A scan with what tells its moment and where the wheels say it was taken.
struct DriveScan {
  LoggedScan scan;
  std::size_t frame = 0;     ///< number of its sensory frame, from 1; 0: it is in none
  std::size_t readings = 0;  ///< odometry readings before it in the file
};

double secondsOf(mrpt::Clock::time_point stamp) {
  return stamp == INVALID_TIMESTAMP ? 0.0 : mrpt::Clock::toDouble(stamp);
}

/// Takes the objects of a rawlog in file order.
class RawlogReader {
 public:
  RawlogReader(std::string path, std::string wanted)
      : path_(std::move(path)), wanted_(std::move(wanted)) {}

  std::vector<DriveScan> scans;
  std::vector<OdometryReading> readings;

  void add(const CSerializable::Ptr& object, std::size_t index) {
    if (auto log = std::dynamic_pointer_cast<mrpt::obs::CRawlog>(object)) {
      for (std::size_t i = 0; i < log->size(); ++i) add(log->getAsGeneric(i), index);
    } else if (auto action = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
      addAction(*action, index);
    } else if (auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
      ++frames_;
      for (const auto& observation : *frame) addObservation(observation, index, frames_);
    } else {
      addObservation(object, index, 0);
    }
  }

 private:
  void addObservation(const CSerializable::Ptr& object, std::size_t index, std::size_t frame) {
    if (auto odometry = std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(object)) {
      const TPose2D pose = odometry->odometry.asTPose();
      requireFinite(pose, index);
      // Where actions say how the robot moves, readings repeat it.
      if (!has_actions_) readings.push_back({secondsOf(odometry->timestamp), pose});
    } else if (auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(object)) {
      const std::string place = "object " + std::to_string(index);
      // Readings of sensors that are not asked for need not be fit for use.
      try {
        scans.push_back({toLoggedScan(*scan), frame, readings.size()});
      } catch (const std::invalid_argument& error) {
        if (!wanted_.empty() && !isAskedFor(scan->sensorLabel, wanted_)) return;
        throw FormatError(path_, place, error.what());
      }
      scans.back().scan.place = place;
    }
  }

  void addAction(mrpt::obs::CActionCollection& action, std::size_t index) {
    const auto movement = action.getBestMovementEstimation();
    if (!movement || !movement->poseChange) {
      throw FormatError(path_, "object " + std::to_string(index),
                        "an action that does not say how the robot moved in the plane");
    }
    const TPose2D step = movement->poseChange->getMeanVal().asTPose();
    requireFinite(step, index);
    if (!has_actions_) {
      // The first action leads to the first frame from where nothing was seen.
      for (DriveScan& scan : scans) scan.readings = 1;
      readings.assign(1, {});
    }
    has_actions_ = true;
    readings.push_back({0.0, readings.back().pose + step});
  }

  void requireFinite(const TPose2D& pose, std::size_t index) const {
    if (std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.phi)) return;
    throw FormatError(path_, "object " + std::to_string(index), "a movement that is not finite");
  }

  std::string path_, wanted_;
  std::size_t frames_ = 0;
  bool has_actions_ = false;
};

TPose2D between(const TPose2D& a, const TPose2D& b, double share) {
  const double turn = std::remainder(b.phi - a.phi, 2.0 * M_PI);
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.phi + share * turn};
}

/// Where the wheels say the robot was when a scan was taken.
std::optional<TPose2D> odometryAt(const DriveScan& scan,
                                  const std::vector<OdometryReading>& readings) {
  if (readings.empty()) return {};
  const double stamp = scan.scan.stamp;
  const std::size_t after = scan.readings;
  if (stamp != 0.0) {
    // Files keep the order of arrival, which is nearly that of time.
    constexpr std::size_t kLook = 4;
    for (std::size_t i = after > kLook ? after - kLook : 1;
         i < std::min(readings.size(), after + kLook); ++i) {
      const double first = readings[i - 1].stamp, second = readings[i].stamp;
      if (first == 0.0 || !(first <= stamp && stamp <= second) || !(first < second)) continue;
      return between(readings[i - 1].pose, readings[i].pose, (stamp - first) / (second - first));
    }
  }
  if (after == 0) return {};
  return readings[after - 1].pose;
}

std::vector<DriveScan> readRawlog(const std::string& path, const ScanFileOptions& options,
                                  Notes* notes) {
  RawlogReader reader(path, options.sensor_label);
  readObjects(path, options.strict, notes,
              [&](const CSerializable::Ptr& object, std::size_t index) {
                reader.add(object, index);
                requireScans(path, "object " + std::to_string(index), reader.scans.size(),
                             options.max_scans);
              });
  std::vector<std::string> labels;
  for (const DriveScan& entry : reader.scans) labels.push_back(entry.scan.label);
  std::vector<DriveScan> scans;
  for (const std::size_t i : selectSensor(path, labels, options.sensor_label)) {
    scans.push_back(std::move(reader.scans[i]));
    scans.back().scan.odometry = odometryAt(scans.back(), reader.readings);
  }
  return scans;
}

std::vector<DriveScan> readCarmen(const std::string& path, const ScanFileOptions& options,
                                  Notes* notes) {
  std::vector<DriveScan> scans;
  for (LoggedScan& scan : loadLoggedCarmen(path, options, notes)) {
    scans.push_back({std::move(scan), 0, 0});
  }
  return scans;
}

/// Whether a scan is of the moment that others began.
bool isOfMoment(const std::vector<const DriveScan*>& moment, const DriveScan& scan) {
  if (moment.empty()) return false;
  for (const DriveScan* other : moment) {
    if (other->scan.label == scan.scan.label) return false;
  }
  const DriveScan& first = *moment.front();
  if (first.frame != 0 || scan.frame != 0) return first.frame == scan.frame;
  constexpr double kRounding = 1e-6;  // [s] of stamps since 1970 in doubles
  return first.scan.stamp != 0.0 && scan.scan.stamp != 0.0 &&
         std::abs(scan.scan.stamp - first.scan.stamp) <= kOneMoment + kRounding;
}

/// Says which sensors are not in every moment.
void noteMissing(const std::vector<std::vector<const DriveScan*>>& moments, Notes* notes) {
  std::map<std::string, std::size_t> counts;
  for (const auto& moment : moments) {
    for (const DriveScan* scan : moment) ++counts[scan->scan.label];
  }
  for (const auto& [label, count] : counts) {
    if (count == moments.size()) continue;
    addNote(notes, "sensor '" + label + "' is in " + std::to_string(count) + " of " +
                       std::to_string(moments.size()) + " moments");
  }
}

}  // namespace

DriveLog loadDrive(const std::string& path, const ScanFileOptions& options,
                   const MotionNoise& noise, Notes* notes) {
  noise.check();
  const std::string extension = contentExtension(path);
  const bool is_rawlog = extension == ".rawlog";
  if (!is_rawlog && extension != ".log" && extension != ".clf") {
    loadScans(path, options, notes);  // which says what is known
  }
  std::vector<DriveScan> scans =
      is_rawlog ? readRawlog(path, options, notes) : readCarmen(path, options, notes);

  std::vector<std::vector<const DriveScan*>> groups;
  for (const DriveScan& scan : scans) {
    if (groups.empty() || !isOfMoment(groups.back(), scan)) groups.emplace_back();
    groups.back().push_back(&scan);
  }
  noteMissing(groups, notes);
  std::vector<std::size_t> sizes;
  std::vector<std::optional<TPose2D>> odometry;
  for (const auto& group : groups) {
    sizes.push_back(group.size());
    odometry.push_back(group.front()->scan.odometry);
  }

  std::vector<LoggedScan> logged;
  for (DriveScan& scan : scans) logged.push_back(std::move(scan.scan));
  std::vector<RangeScan> converted = toRangeScans(path, std::move(logged), options.readings, notes);

  DriveLog log;
  std::size_t next = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    Moment moment;
    for (std::size_t k = 0; k < sizes[i]; ++k) {
      moment.scans.push_back(std::move(converted[next++]));
    }
    moment.is_after_gap = i == 0 || !odometry[i] || !odometry[i - 1];
    if (!moment.is_after_gap) {
      moment.since_before = measuredMotion(*odometry[i] - *odometry[i - 1], noise);
    }
    log.has_odometry = log.has_odometry || odometry[i].has_value();
    log.moments.push_back(std::move(moment));
  }
  return log;
}

}  // namespace mrpt_polyloc
