#include "tests/support/bridge_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/io/replay_log.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>

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
using testing::AllOf;
using testing::HasSubstr;

class ReplayLog : public test::QuietTest {
 protected:
  std::string action(const CPose2D& increment) const {
    CActionRobotMovement2D movement;
    CActionRobotMovement2D::TMotionModelOptions model;
    model.modelSelection = CActionRobotMovement2D::mmGaussian;
    movement.computeFromOdometry(increment, model);
    CActionCollection actions;
    actions.insert(movement);
    return test::serialised(actions);
  }
  std::string frame(const std::vector<std::string>& labels) {
    CSensoryFrame sf;
    for (const std::string& label : labels) {
      sf.insert(CObservation2DRangeScan::Create(test::randomObservation(random_, 20, label)));
    }
    sf.insert(mrpt::obs::CObservationComment::Create());
    return test::serialised(sf);
  }
  std::string scan(const std::string& label = "A") {
    return test::serialised(test::randomObservation(random_, 20, label));
  }
  static std::string odometry(const CPose2D& pose) {
    CObservationOdometry observation;
    observation.odometry = pose;
    return test::serialised(observation);
  }
  std::vector<ReplayStep> load(const std::string& bytes, const std::string& label = {},
                               const OdometryNoise& noise = {}) {
    test::writeFile(path_, test::gzipped(bytes));
    return loadReplayLog(path_, test::ofSensor(label), noise);
  }
  std::string errorOf(const std::string& bytes, const std::string& label = {}) {
    test::writeFile(path_, bytes);
    ScanFileOptions options = test::ofSensor(label);
    options.strict = true;
    return formatErrorOf([&] { loadReplayLog(path_, options); });
  }
  static void expectMovement(const ReplayStep& step, const CPose2D& expected) {
    ASSERT_TRUE(step.action);
    const CPose2D mean = step.action->getBestMovementEstimation()->poseChange->getMeanVal();
    EXPECT_NEAR(mean.x(), expected.x(), 1e-9);
    EXPECT_NEAR(mean.y(), expected.y(), 1e-9);
    EXPECT_NEAR(std::remainder(mean.phi() - expected.phi(), 2 * M_PI), 0.0, 1e-9);
  }

  std::string path_ = dir_.file("test.rawlog");
  std::mt19937 random_{3};
  const CPose2D a_{0.3, 0.1, 0.5}, b_{0.2, -0.1, -0.2}, c_{-0.1, 0.0, 1.0};
};

TEST_F(ReplayLog, PairsActionsWithFrames) {
  const auto steps = load(action(a_) + frame({""}) + action(b_) + frame({""}) + action(c_));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_FALSE(steps[0].action);  // nothing is before the first scan
  expectMovement(steps[1], b_);
  EXPECT_EQ(steps[1].frame->size(), 2U);  // as recorded, with the comment
  EXPECT_EQ(steps[1].object, 3U);
  EXPECT_EQ(steps[0].pair, 0U);
  EXPECT_EQ(steps[1].pair, 1U);
  EXPECT_EQ(steps[1].scan.beams().size(), 20U);
}

TEST_F(ReplayLog, ComposesActionsBetweenFramesWithScans) {
  const auto steps = load(frame({"A"}) + action(a_) + frame({}) + action(b_) + action(c_) +
                          frame({"A"}) + frame({"A"}));
  ASSERT_EQ(steps.size(), 3U);
  expectMovement(steps[1], a_ + b_ + c_);
  expectMovement(steps[2], {});  // no action: it stood still
  EXPECT_EQ(steps[0].pair, std::nullopt);
  EXPECT_EQ(steps[1].pair, 1U);  // 0 is the pair of the frame without scans
  EXPECT_EQ(steps[2].pair, std::nullopt);
}

TEST_F(ReplayLog, TakesMovementsOfObservationLogsFromOdometry) {
  OdometryNoise noise;
  noise.min_std_xy = 0.15;
  noise.min_std_phi = 0.04;
  const CPose2D start(5, 6, 2.0);
  const auto steps =
      load(odometry(start) + scan() + odometry(start + a_) + odometry(start + a_ + b_) + scan() +
               scan() + odometry(start + a_ + b_ + c_) + scan(),
           {}, noise);
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_FALSE(steps[0].action);
  expectMovement(steps[1], a_ + b_);
  expectMovement(steps[2], {});
  expectMovement(steps[3], c_);
  EXPECT_EQ(steps[3].pair, 3U);
  const auto [covariance, mean] =
      steps[2].action->getBestMovementEstimation()->poseChange->getCovarianceAndMean();
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 0.15, 1e-6);
  EXPECT_NEAR(std::sqrt(covariance(2, 2)), 0.04, 1e-6);
}

TEST_F(ReplayLog, ReplacesTheRecordedNoiseOfActionsIfAsked) {
  OdometryNoise noise;
  noise.min_std_xy = 0.3;
  const std::string bytes = frame({"A"}) + action(a_) + frame({"A"});
  for (const bool replaces : {false, true}) {
    noise.replaces_recorded = replaces;
    const auto steps = load(bytes, {}, noise);
    expectMovement(steps[1], a_);
    const auto [covariance, mean] =
        steps[1].action->getBestMovementEstimation()->poseChange->getCovarianceAndMean();
    EXPECT_EQ(covariance(0, 0) > 0.09, replaces);
  }
}

TEST_F(ReplayLog, StandsStillWhereThereIsNoOdometry) {
  const auto steps = load(scan() + scan() + odometry(a_) + scan() + odometry(a_ + b_) + scan());
  ASSERT_EQ(steps.size(), 4U);
  expectMovement(steps[1], {});
  expectMovement(steps[2], {});  // the first reading says only where odometry starts
  expectMovement(steps[3], b_);
}

TEST_F(ReplayLog, ChoosesTheSensorAndKeepsTheFrame) {
  const std::string bytes =
      frame({"A", "B"}) + action(a_) + frame({"A"}) + action(b_) + frame({"B", "A", "B"});
  const auto steps = load(bytes, "B");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].laser->sensorLabel, "B");
  expectMovement(steps[1], a_ + b_);
  EXPECT_EQ(steps[1].frame->size(), 4U);
  EXPECT_EQ(steps[1].laser, steps[1].frame->getObservationByIndex(0));
  EXPECT_THAT(errorOf(bytes), AllOf(HasSubstr(path_), HasSubstr("A"), HasSubstr("B")));
}

TEST_F(ReplayLog, ReadsAWholeLogStoredAsOneObject) {
  mrpt::obs::CRawlog log;
  CSensoryFrame sf;
  sf.insert(CObservation2DRangeScan::Create(test::randomObservation(random_, 5)));
  log.insert(sf);
  log.insert(sf);
  EXPECT_EQ(load(test::serialised(log)).size(), 2U);
}

TEST_F(ReplayLog, TellsTheObservationsWhatIsKnownOfTheSensor) {
  test::writeFile(path_, scan() + scan() + scan());
  ScanFileOptions options;
  options.readings.max_range = 20.0;
  options.readings.min_range = 5.0;
  const auto steps = loadReplayLog(path_, options);
  ASSERT_EQ(steps.size(), 3U);
  for (const ReplayStep& step : steps) {
    EXPECT_EQ(step.laser->maxRange, 20.0F);
    EXPECT_TRUE(test::sameScans({toRangeScan(*step.laser)}, {step.scan}));
    for (const Beam& beam : step.scan.beams()) {
      EXPECT_TRUE(beam.kind == BeamKind::invalid || (beam.range >= 5.0 && beam.range <= 20.0));
    }
  }
}

TEST_F(ReplayLog, RefusesWhatItCannotReplay) {
  EXPECT_THAT(errorOf(odometry(a_)), AllOf(HasSubstr(path_), HasSubstr("no")));
  EXPECT_THAT(errorOf(scan() + scan().substr(0, 60)),
              AllOf(HasSubstr("object 1"), HasSubstr("ends inside")));
  EXPECT_THAT(errorOf(scan() + test::serialised(CActionCollection())),
              AllOf(HasSubstr("object 1"), HasSubstr("how the robot moved")));
  CActionCollection spatial;
  spatial.insert(mrpt::obs::CActionRobotMovement3D());
  EXPECT_THAT(errorOf(scan() + test::serialised(spatial) + scan()), HasSubstr("object 1"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(errorOf(scan() + odometry(CPose2D(nan, 0, 0)) + scan()),
              AllOf(HasSubstr("object 1"), HasSubstr("not finite")));
  auto tilted = test::randomObservation(random_, 5);
  tilted.sensorPose.setFromValues(0, 0, 0, 0, 0.3, 0);
  EXPECT_THAT(errorOf(scan("LASER") + test::serialised(tilted)),
              AllOf(HasSubstr("object 1"), HasSubstr("tilted by 17")));
}

TEST_F(ReplayLog, ReplaysScansThatSayNothing) {
  auto nothing = test::randomObservation(random_, 0);
  auto numbers = test::randomObservation(random_, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    numbers.setScanRange(i, std::numeric_limits<float>::quiet_NaN());
    numbers.setScanRangeValidity(i, true);
  }
  const auto steps = load(test::serialised(nothing) + test::serialised(numbers));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].scan.beams().size(), 0U);
  EXPECT_EQ(steps[1].scan.hitCount(), 0U);
}

TEST_F(ReplayLog, RefusesNegativeNoise) {
  OdometryNoise noise;
  noise.min_std_phi = -1.0;
  EXPECT_THROW(load(scan(), {}, noise), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
