#include "tests/support/bridge_files.h"
#include "tests/support/data_dir.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/drive_log.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CSensoryFrame;
using mrpt::poses::CPose2D;
using test::formatErrorOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DriveLogTest : public test::QuietTest {
 protected:
  static std::string action(const CPose2D& increment) {
    CActionRobotMovement2D movement;
    CActionRobotMovement2D::TMotionModelOptions model;
    model.modelSelection = CActionRobotMovement2D::mmGaussian;
    movement.computeFromOdometry(increment, model);
    CActionCollection actions;
    actions.insert(movement);
    return test::serialised(actions);
  }
  CObservation2DRangeScan observation(const std::string& label, double stamp) {
    CObservation2DRangeScan scan = test::randomObservation(random_, 20, label);
    scan.timestamp = mrpt::Clock::fromDouble(stamp);
    return scan;
  }
  std::string scan(const std::string& label, double stamp) {
    return test::serialised(observation(label, stamp));
  }
  std::string frame(const std::vector<std::string>& labels, double stamp = 1e9) {
    CSensoryFrame sf;
    for (const std::string& label : labels) {
      sf.insert(CObservation2DRangeScan::Create(observation(label, stamp)));
    }
    return test::serialised(sf);
  }
  static std::string odometry(const CPose2D& pose, double stamp) {
    CObservationOdometry observation;
    observation.odometry = pose;
    observation.timestamp = mrpt::Clock::fromDouble(stamp);
    return test::serialised(observation);
  }
  DriveLog load(const std::string& bytes, const std::string& sensors, Notes* notes = nullptr) {
    test::writeFile(path_, test::gzipped(bytes));
    return loadDrive(path_, test::ofSensor(sensors), {}, notes);
  }
  static std::vector<std::string> labelsOf(const DriveLog& log) {
    std::vector<std::string> labels;
    for (const Moment& moment : log.moments) {
      labels.emplace_back();
      for (const RangeScan& scan : moment.scans) labels.back() += scan.label();
    }
    return labels;
  }

  std::string path_ = dir_.file("test.rawlog");
  std::mt19937 random_{3};
};

TEST_F(DriveLogTest, ActionsLeadFromFrameToFrame) {
  const std::string bytes = action({9, 9, 9}) + frame({"A", "B"}) + action({0.5, 0, 0.1}) +
                            frame({"C"}) + action({0.2, 0.1, -0.3}) + frame({"A", "B", "C"});
  const DriveLog log = load(bytes, "A,B");
  EXPECT_TRUE(log.has_odometry);
  EXPECT_THAT(labelsOf(log), ElementsAre("AB", "AB"));
  EXPECT_TRUE(log.moments[0].is_after_gap);
  EXPECT_FALSE(log.moments[1].is_after_gap);
  const mrpt::math::TPose2D way = (CPose2D(0.5, 0, 0.1) + CPose2D(0.2, 0.1, -0.3)).asTPose();
  const Motion& motion = log.moments[1].since_before;
  EXPECT_NEAR(motion.pose_before_after.x, way.x, 1e-9);
  EXPECT_NEAR(motion.pose_before_after.y, way.y, 1e-9);
  EXPECT_NEAR(motion.pose_before_after.phi, way.phi, 1e-9);
  EXPECT_GT(motion.covariance(0, 0), 0.0);
}

TEST_F(DriveLogTest, ScansWithinFiftyMillisecondsAreOfOneMoment) {
  const double t = 1e9;
  const std::string bytes = scan("A", t) + scan("B", t + 0.04) + scan("A", t + 0.1) +
                            scan("B", t + 0.16) + scan("A", t + 0.2) + scan("A", t + 0.21);
  Notes notes;
  const DriveLog log = load(bytes, "all", &notes);
  EXPECT_THAT(labelsOf(log), ElementsAre("AB", "A", "BA", "A"));
  EXPECT_FALSE(log.has_odometry);
  for (const Moment& moment : log.moments) EXPECT_TRUE(moment.is_after_gap);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("'B' is in 2 of 4 moments")));
}

TEST_F(DriveLogTest, OdometryIsInterpolatedToTheTimeOfTheScan) {
  const double t = 1e9;
  const std::string bytes = scan("A", t - 1) + odometry({1, 0, 3.0}, t) + scan("A", t + 0.25) +
                            odometry({2, 0, -3.0}, t + 1) + scan("A", t + 1.5) +
                            odometry({4, 2, -3.0}, t + 2);
  const DriveLog log = load(bytes, {});
  ASSERT_EQ(log.moments.size(), 3U);
  EXPECT_TRUE(log.moments[1].is_after_gap) << "nothing is known of the first";
  EXPECT_FALSE(log.moments[2].is_after_gap);
  const double turn = 2 * M_PI - 6.0;
  const CPose2D first(1.25, 0, 3.0 + 0.25 * turn), second(3, 1, -3.0);
  const mrpt::math::TPose2D way = (second - first).asTPose();
  EXPECT_NEAR(log.moments[2].since_before.pose_before_after.x, way.x, 1e-6);
  EXPECT_NEAR(log.moments[2].since_before.pose_before_after.y, way.y, 1e-6);
  EXPECT_NEAR(log.moments[2].since_before.pose_before_after.phi, way.phi, 1e-6);
}

TEST_F(DriveLogTest, WhatIsWrongIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(formatErrorOf([&] { load(frame({"A", "B"}), {}); }), HasSubstr("several sensors"));
  EXPECT_THAT(formatErrorOf([&] { load(frame({"A", "B"}), "A,X"); }), HasSubstr("sensor 'X'"));
  EXPECT_THAT(formatErrorOf([&] {
                load(scan("A", 1) + odometry({nan, 0, 0}, 2), {});
              }),
              HasSubstr("object 1"));
  EXPECT_THAT(formatErrorOf([&] { loadDrive(dir_.file("none.txt")); }),
              HasSubstr("unknown extension"));
}

TEST_F(DriveLogTest, ASensorUpsideDownIsMirroredAndOneThatIsTiltedRefusedIfItIsAskedFor) {
  CObservation2DRangeScan upright = observation("A", 1e9), upside_down = upright;
  upside_down.sensorLabel = "B";
  upside_down.sensorPose.setYawPitchRoll(upright.sensorPose.yaw(), 0, M_PI);
  CSensoryFrame sf;
  sf.insert(CObservation2DRangeScan::Create(upright));
  sf.insert(CObservation2DRangeScan::Create(upside_down));
  const DriveLog log = load(test::serialised(sf), "all");
  ASSERT_EQ(log.moments.front().scans.size(), 2U);
  const std::vector<Beam>& a = log.moments.front().scans[0].beams();
  const std::vector<Beam>& b = log.moments.front().scans[1].beams();
  ASSERT_EQ(a.size(), b.size());
  const double yaw = upright.sensorPose.yaw();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].kind == BeamKind::invalid) continue;
    EXPECT_NEAR(std::remainder(a[i].bearing + b[i].bearing - 2 * yaw, 2 * M_PI), 0.0, 1e-5);
  }
  upside_down.sensorPose.setYawPitchRoll(0, 0.6, 0);
  const std::string bytes = test::serialised(upright) + test::serialised(upside_down);
  EXPECT_NO_THROW(load(bytes, "A"));
  EXPECT_THAT(formatErrorOf([&] { load(bytes, "all"); }), HasSubstr("object 1"));
}

TEST_F(DriveLogTest, CarmenLinesHoldTheWheels) {
  POLYLOC_DATA_OR_SKIP(data);
  const DriveLog log = loadDrive(data + "/carmen/intel-corrected.log.gz");
  EXPECT_TRUE(log.has_odometry);
  ASSERT_GT(log.moments.size(), 100U);
  double way = 0.0;
  for (std::size_t i = 1; i < log.moments.size(); ++i) {
    EXPECT_FALSE(log.moments[i].is_after_gap);
    way += log.moments[i].since_before.length();
  }
  EXPECT_GT(way, 100.0);
}

TEST_F(DriveLogTest, BothLasersOfCase15) {
  POLYLOC_DATA_OR_SKIP(data);
  const std::string file = data + "/cases/15-two-lasers/scans.rawlog";
  const DriveLog both = loadDrive(file, test::ofSensor("all"));
  EXPECT_EQ(both.moments.size(), 60U);
  for (const Moment& moment : both.moments) EXPECT_EQ(moment.scans.size(), 2U);
  EXPECT_EQ(labelsOf(loadDrive(file, test::ofSensor("front"))).front(), "front");
}

}  // namespace
}  // namespace mrpt_polyloc
