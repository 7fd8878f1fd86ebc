#include "driven_room.h"

#include "tests/support/bridge_files.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/evaluation/truth.h>
#include <mrpt_polyloc/io/observation.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;

/// That of ProgramTest::roomFile().
PolygonMap room() {
  return mapOf(
      {{0, 0}, {8, 0}, {8, 3}, {6, 3}, {6, 5}, {2.5, 5}, {2.5, 6.2}, {1, 6.2}, {1, 5}, {0, 5}},
      {{{4, 1}, {5.5, 1.6}, {4, 2.2}}});
}

TPose2D onTheWay(std::size_t step) {
  const double t = static_cast<double>(step);
  return {1.0 + 0.14 * t, 0.5 + 0.15 * std::sin(0.35 * t), 0.4 * std::sin(0.25 * t)};
}

double stampOf(std::size_t step) {
  return 1e9 + 0.1 * static_cast<double>(step);
}

}  // namespace

Drive driveThroughRoom(std::size_t steps, std::uint32_t seed) {
  const PolygonMap map = room();
  Drive drive;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  ScanOptions options;
  options.beams = 120;
  options.field_of_view = 4.0 * kPi / 3.0;
  options.sigma = 0.01;
  options.sensor = {0.1, 0.0};
  CPose2D odometry(2.0, -1.0, 0.7);
  for (std::size_t i = 0; i < steps; ++i) {
    const TPose2D pose = onTheWay(i);
    if (i > 0) {
      const CPose2D driven = CPose2D(pose) - CPose2D(drive.truth.back());
      odometry = odometry + driven +
                 CPose2D(0.01 * noise(random), 0.01 * noise(random), 0.009 * noise(random));
    }
    options.seed = seed * 1000 + static_cast<std::uint32_t>(i);
    const double spacing = options.field_of_view / static_cast<double>(options.beams);
    auto scan = toObservation(simulatedScan(map, pose, options), options.field_of_view - spacing,
                              0.0, 30.0);
    scan.timestamp = mrpt::Clock::fromDouble(stampOf(i));
    drive.truth.push_back(pose);
    drive.odometry.push_back(odometry.asTPose());
    drive.scans.push_back(scan);
  }
  return drive;
}

void writeActionLog(const std::string& path, const Drive& drive) {
  mrpt::obs::CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = mrpt::obs::CActionRobotMovement2D::mmGaussian;
  std::string bytes;
  CPose2D last(drive.odometry.front());
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.computeFromOdometry(CPose2D(drive.odometry[i]) - last, model);
    last = CPose2D(drive.odometry[i]);
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(mrpt::obs::CObservation2DRangeScan::Create(drive.scans[i]));
    bytes += serialised(actions) + serialised(frame);
  }
  writeFile(path, gzipped(bytes));
}

void writeObservationLog(const std::string& path, const Drive& drive) {
  std::string bytes;
  for (std::size_t i = 0; i < drive.scans.size(); ++i) {
    mrpt::obs::CObservationOdometry reading;
    reading.odometry = CPose2D(drive.odometry[i]);
    reading.timestamp = drive.scans[i].timestamp;
    bytes += serialised(reading) + serialised(drive.scans[i]);
  }
  writeFile(path, gzipped(bytes));
}

std::string indexedTruth(const Drive& drive) {
  std::string text;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    char line[120];
    std::snprintf(line, sizeof line, "%zu %.6f %.6f %.6f\n", i, drive.truth[i].x, drive.truth[i].y,
                  drive.truth[i].phi);
    text += line;
  }
  return text;
}

std::string tumTruth(const Drive& drive) {
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < drive.truth.size(); ++i)
    poses.push_back({stampOf(i), drive.truth[i]});
  return toTum(poses);
}

}  // namespace mrpt_polyloc::test
