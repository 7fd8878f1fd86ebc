#include "posed_scans.h"

#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/GzInputStream.h>
#include <mrpt_polyloc/io/carmen_line.h>
#include <mrpt_polyloc/io/file_extension.h>
#include <mrpt_polyloc/io/mrpt_archive.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/sensor_labels.h>
#include <mrpt_polyloc/io/sensor_survey.h>

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <cstdio>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// The laser's pose of each line of one keyword: after the ranges stand x, y, theta of the laser,
/// then those of the odometry. Corrected logs have the corrected pose in the former.
std::vector<TPose2D> carmenPoses(const std::string& path, const std::string& keyword) {
  GzInputStream stream(path, GzInputStream::AtCut::end);
  std::vector<TPose2D> poses;
  std::string text;
  for (std::size_t number = 1; stream.readLine(text); ++number) {
    CarmenLine line(path, number, text);
    if (line.keyword() != keyword) continue;
    if (!stream.lineHadEnd()) break;  // cut short, as loadCarmen() leaves it out
    const std::size_t ranges = line.count("the number of ranges");
    for (std::size_t i = 0; i < ranges; ++i) line.word("a range");
    const double x = line.finite("x of the laser"), y = line.finite("y of the laser");
    poses.emplace_back(x, y, line.finite("theta of the laser"));
  }
  return poses;
}

/// The laser scans of a simplemap at the mean poses of their keyframes.
PosedScans simplemapScans(const std::string& path, const ScanFileOptions& options, Notes& notes) {
  GzInputStream stream(path);
  const auto map = std::dynamic_pointer_cast<mrpt::maps::CSimpleMap>(readObject(stream, 0));
  if (!map) throw FormatError(path, "object 0", "is no simplemap");
  std::vector<LoggedScan> logged;
  std::vector<std::string> labels;
  std::vector<TPose2D> poses;
  // By iterators: get() hands out another type from MRPT 2.11.5 on.
  for (const auto& keyframe : *map) {
    const TPose2D pose(keyframe.pose->getMeanVal().asTPose());
    for (const auto& observation : *keyframe.sf) {
      const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(observation);
      if (!scan) continue;
      logged.push_back(toLoggedScan(*scan));
      labels.push_back(scan->sensorLabel);
      poses.push_back(pose);
    }
  }
  PosedScans drive;
  std::vector<LoggedScan> chosen;
  for (const std::size_t i : selectSensor(path, labels, options.sensor_label)) {
    chosen.push_back(logged[i]);
    drive.poses.push_back(poses[i]);
  }
  drive.scans = toRangeScans(path, std::move(chosen), options.readings, &notes);
  return drive;
}

void requireDrive(const PosedScans& drive, const std::string& path, double most_jump) {
  double way = 0.0;
  for (std::size_t i = 1; i < drive.poses.size(); ++i) {
    const double step = std::hypot(drive.poses[i].x - drive.poses[i - 1].x,
                                   drive.poses[i].y - drive.poses[i - 1].y);
    way += step;
    if (step > most_jump) {
      throw FormatError(path, "scan " + std::to_string(i),
                        formatted("a jump of %.2f m from the scan before: not one drive, or poses "
                                  "that are not corrected (--max-jump M allows more)",
                                  step));
    }
  }
  if (way == 0.0) throw FormatError(path, "", "its poses never move: it has none, or no drive");
}

}  // namespace

PosedScans loadPosedScans(const std::string& log, const std::string& poses,
                          const ScanFileOptions& options, double most_jump, Notes& notes) {
  const std::string extension = contentExtension(log);
  PosedScans drive;
  if (extension == ".simplemap" && poses.empty()) {
    drive = simplemapScans(log, options, notes);
    requireDrive(drive, log, most_jump);
    return drive;
  }
  drive.scans = loadScans(log, options, &notes);
  if (!poses.empty()) {
    drive.poses = matchTruth(drive.scans, loadTum(poses), poses);
    requireDrive(drive, poses, most_jump);
    return drive;
  }
  if (extension != ".log" && extension != ".clf") {
    throw FormatError(log, "", "such a log says no corrected poses: --poses TRUTH.tum is needed");
  }
  const std::string keyword = drive.scans.front().label();
  if (keyword != "FLASER" && keyword != "RLASER") {
    throw FormatError(log, "", keyword + " says no corrected poses: --poses TRUTH.tum is needed");
  }
  const std::vector<TPose2D> lasers = carmenPoses(log, keyword);
  if (lasers.size() != drive.scans.size()) {
    throw FormatError(log, "",
                      std::to_string(lasers.size()) + " poses for " +
                          std::to_string(drive.scans.size()) + " scans");
  }
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    drive.poses.push_back(drive.scans[i].robotFromBeamFrame(lasers[i]));
  }
  requireDrive(drive, log, most_jump);
  return drive;
}

}  // namespace mrpt_polyloc::apps
