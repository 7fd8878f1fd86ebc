#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

class AllowedPosesTest : public ::testing::Test {
 protected:
  PolygonMap map_ = squareMap(4.0);
  Triangulation triangulation_{map_};
  TPoint2D sensor_{0.3, -0.1};
  RangeScan frame_{{}, sensor_};  // for its conversions
};

TEST_F(AllowedPosesTest, FreeSpaceIsTheSensors) {
  const PosePrior prior;
  const AllowedPoses allowed(triangulation_, prior, sensor_);
  EXPECT_TRUE(allowed.contains({0.1, 0.1, 0.0}));  // the robot is outside
  EXPECT_FALSE(allowed.contains({-0.1, 0.1, 0.0}));
}

TEST_F(AllowedPosesTest, ThePriorIsTheRobots) {
  PosePrior prior;
  prior.near = PosePrior::Disk{1.0, 1.0, 0.2};
  prior.compass = PosePrior::Compass{3.0, 0.2};
  const AllowedPoses allowed(triangulation_, prior, sensor_);
  EXPECT_TRUE(allowed.contains(frame_.beamFrameFromRobot({1.1, 1.1, 3.1})));
  EXPECT_FALSE(allowed.contains({1.0, 1.0, 3.1}));
  EXPECT_TRUE(allowed.contains(frame_.beamFrameFromRobot({1.0, 1.0, -3.1})));  // across pi
  EXPECT_FALSE(allowed.contains(frame_.beamFrameFromRobot({1.0, 1.0, 2.7})));
}

TEST_F(AllowedPosesTest, TheNearestPoseIsAllowedAndNoOtherIsNearer) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  PosePrior prior;
  prior.near = PosePrior::Disk{2.0, 2.0, 0.5};
  prior.compass = PosePrior::Compass{-2.9, 0.4};
  const AllowedPoses allowed(triangulation_, prior, sensor_);
  for (int i = 0; i < 500; ++i) {
    const TPose2D pose{2.0 + 2.0 * unit(random), 2.0 + 2.0 * unit(random), kPi * unit(random)};
    const TPose2D nearest = allowed.nearest(pose);
    EXPECT_TRUE(allowed.contains(nearest));
    EXPECT_LE(angleBetween(nearest.phi, pose.phi),
              std::max(0.0, angleBetween(pose.phi, prior.compass->heading) - 0.4) + 1e-9);
    if (allowed.contains(pose)) {
      EXPECT_LT(distanceBetween(nearest, pose), 1e-12);
      EXPECT_LT(turnBetween(nearest, pose), 1e-12);
    }
  }
}

TEST_F(AllowedPosesTest, TheLastOnTheWayIsAtTheBorder) {
  const PosePrior prior;
  const AllowedPoses allowed(triangulation_, prior, sensor_);
  const TPose2D last = allowed.lastOnTheWay({3.9, 1.0, 3.1}, {4.3, 1.4, -3.1});
  EXPECT_TRUE(allowed.contains(last));
  EXPECT_NEAR(last.x, 4.0, 1e-3);
  EXPECT_NEAR(last.y, 1.1, 1e-3);
  EXPECT_LT(angleBetween(last.phi, 3.1 + 0.25 * (2 * kPi - 6.2)), 1e-3);  // the short way round
}

}  // namespace
}  // namespace mrpt_polyloc::test
