#include "tests/support/BruteForceRays.h"
#include "tests/support/map_factories.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/DriveSimulator.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/io/drive_log.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/rawlog_writer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

PolygonMap room() {
  return mapOf({{0, 0}, {8, 0}, {8, 3}, {5, 3}, {5, 6}, {0, 6}}, {rectangle(2, 2, 2.6, 2.6)});
}

DriveSimulatorParams twoLasers() {
  DriveSimulatorParams params;
  params.laser.fov = 4.7;
  params.laser.beams = 100;
  params.laser.sigma = 0.0;
  params.lasers = {{"front", {0.2, 0.1, 0.5}}, {"rear", {-0.2, -0.1, -2.6}}};
  return params;
}

TEST(DriveSimulator, EachLaserSeesFromItsPlace) {
  const PolygonMap map = room();
  DriveSimulatorParams params = twoLasers();
  params.step = 0.4;
  const BruteForceRays rays(map);
  for (const SimulatedMoment& moment : simulateMoments(map, params, 15, 3)) {
    ASSERT_EQ(moment.observations.size(), 2U);
    for (const auto& observation : moment.observations) {
      const RangeScan scan = toRangeScan(observation);
      const TPose2D beams = scan.beamFrameFromRobot(moment.truth.pose_map_robot);
      for (const Beam& beam : scan.beams()) {
        if (beam.kind != BeamKind::hit) continue;
        EXPECT_NEAR(beam.range, rays.cast({beams.x, beams.y}, beams.phi + beam.bearing).wall, 0.02);
      }
      EXPECT_NEAR(scan.stamp(), moment.truth.stamp, 1e-6);
    }
  }
}

TEST(DriveSimulator, DrivesWithClearanceAStepAtATime) {
  const PolygonMap map = room();
  DriveSimulatorParams params = twoLasers();
  params.step = 0.3;
  params.odometry = {0, 0, 0};
  const WallSegments walls(map);
  const auto moments = simulateMoments(map, params, 200, 5);
  double length = 0.0;
  for (std::size_t i = 1; i < moments.size(); ++i) {
    const TPose2D &a = moments[i - 1].truth.pose_map_robot, &b = moments[i].truth.pose_map_robot;
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 0.3, 1e-9);
    length += std::hypot(b.x - a.x, b.y - a.y);
    EXPECT_TRUE(map.contains({b.x, b.y}));
    EXPECT_GE(walls.distance({b.x, b.y}), params.laser.clearance);
    const TPose2D there = a + moments[i].measured;
    EXPECT_NEAR(there.x, b.x, 1e-9);
    EXPECT_NEAR(there.y, b.y, 1e-9);
  }
  EXPECT_NEAR(length, 199 * 0.3, 1e-6);
  EXPECT_EQ(moments.front().measured, TPose2D(0, 0, 0));
}

TEST(DriveSimulator, ItsRawlogIsReadBackAsTheDrive) {
  const PolygonMap map = room();
  DriveSimulatorParams params = twoLasers();
  params.step = 0.5;
  const auto moments = simulateMoments(map, params, 8, 2);
  std::vector<RawlogMoment> logged;
  for (const SimulatedMoment& moment : moments) {
    logged.push_back({moment.measured, moment.observations});
  }
  const std::string path =
      (std::filesystem::temp_directory_path() / "polyloc_drive_simulator_test.rawlog").string();
  writeDriveRawlog(path, logged, params.odometry);
  ScanFileOptions options;
  options.sensor_label = "all";
  const DriveLog log = loadDrive(path, options);
  std::filesystem::remove(path);
  EXPECT_TRUE(log.has_odometry);
  ASSERT_EQ(log.moments.size(), moments.size());
  for (std::size_t i = 0; i < moments.size(); ++i) {
    ASSERT_EQ(log.moments[i].scans.size(), 2U);
    EXPECT_EQ(log.moments[i].scans[1].label(), "rear");
    if (i == 0) continue;
    const TPose2D& way = log.moments[i].since_before.pose_before_after;
    EXPECT_NEAR(way.x, moments[i].measured.x, 1e-6);
    EXPECT_NEAR(way.phi, moments[i].measured.phi, 1e-6);
  }
}

TEST(DriveSimulator, IsOfItsSeedAndNamesWhatIsWrong) {
  const PolygonMap map = room();
  DriveSimulatorParams params = twoLasers();
  params.step = 0.4;
  const auto a = simulateMoments(map, params, 10, 1), b = simulateMoments(map, params, 10, 1);
  EXPECT_EQ(a.back().truth.pose_map_robot, b.back().truth.pose_map_robot);
  EXPECT_EQ(a.back().measured, b.back().measured);
  EXPECT_NE(a.back().truth.pose_map_robot,
            simulateMoments(map, params, 10, 2).back().truth.pose_map_robot);
  params.lasers[1].label = "front";
  EXPECT_THROW(params.check(), InvalidParamsError);
  params.lasers.clear();
  EXPECT_THROW(params.check(), InvalidParamsError);
  DriveSimulatorParams stuck;
  stuck.step = 40.0;
  EXPECT_THROW(simulateMoments(map, stuck, 3, 1), InvalidMapError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
