#include "tests/support/constants.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <gtest/gtest.h>

#include <random>

namespace mrpt_polyloc::test {
namespace {

TEST(RangeScan, BeamsWithoutAUsableRangeOrBearingAreInvalid) {
  for (const BeamKind kind : {BeamKind::hit, BeamKind::no_return}) {
    for (const double range : {kNaN, kInfinity, -kInfinity, -1.0, 0.0, -0.0, 1e39}) {
      const RangeScan scan({{0.5, range, kind}});
      EXPECT_EQ(scan.beams()[0].kind, BeamKind::invalid) << range;
      EXPECT_EQ(scan.beams()[0].range, 0.0);
      EXPECT_EQ(scan.beams()[0].bearing, 0.0);
    }
    for (const double bearing : {kNaN, kInfinity, -kInfinity}) {
      EXPECT_EQ(RangeScan({{bearing, 2.0, kind}}).beams()[0].kind, BeamKind::invalid) << bearing;
    }
    const RangeScan good({{-7.0, 1e-3, kind}});
    EXPECT_EQ(good.beams()[0].kind, kind);
    EXPECT_EQ(good.beams()[0].range, 1e-3);
    EXPECT_EQ(good.beams()[0].bearing, -7.0);
  }
}

TEST(RangeScan, InvalidBeamsCarryNothing) {
  const RangeScan scan({{1.0, 2.0, BeamKind::invalid}, {kNaN, kNaN, BeamKind::invalid}});
  for (const Beam& beam : scan.beams()) {
    EXPECT_EQ(beam.kind, BeamKind::invalid);
    EXPECT_EQ(beam.range, 0.0);
    EXPECT_EQ(beam.bearing, 0.0);
  }
}

TEST(RangeScan, CountsAndKeepsTheOrder) {
  const RangeScan scan({{0.3, 1, BeamKind::hit},
                        {0.1, 2, BeamKind::no_return},
                        {0.2, kNaN, BeamKind::hit},
                        {0.0, 3, BeamKind::hit},
                        {0.0, 3, BeamKind::invalid}},
                       {0.1, 0.2}, 12.5, "front");
  EXPECT_EQ(scan.hitCount(), 2U);
  EXPECT_EQ(scan.noReturnCount(), 1U);
  ASSERT_EQ(scan.beams().size(), 5U);
  EXPECT_EQ(scan.beams()[0].bearing, 0.3);
  EXPECT_EQ(scan.beams()[3].range, 3.0);
  EXPECT_EQ(scan.sensor(), TPoint2D(0.1, 0.2));
  EXPECT_EQ(scan.stamp(), 12.5);
  EXPECT_EQ(scan.label(), "front");
  EXPECT_EQ(RangeScan({}).hitCount() + RangeScan({}).noReturnCount(), 0U);
}

TEST(RangeScan, ASensorAheadOfTheRobotIsAheadInTheMap) {
  const RangeScan scan({}, {1.0, 0.5});
  const auto beams = scan.beamFrameFromRobot({10, 20, kPi / 2});
  EXPECT_NEAR(beams.x, 9.5, 1e-12);  // the robot faces +y: its left is -x
  EXPECT_NEAR(beams.y, 21.0, 1e-12);
  EXPECT_NEAR(beams.phi, kPi / 2, 1e-12);
}

TEST(RangeScan, RobotAndBeamFrameAreInverse) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-4, 4);
  for (int i = 0; i < 100; ++i) {
    const RangeScan scan({}, {draw(random), draw(random)});
    const mrpt::math::TPose2D pose(draw(random), draw(random), draw(random));
    for (const auto& back : {scan.robotFromBeamFrame(scan.beamFrameFromRobot(pose)),
                             scan.beamFrameFromRobot(scan.robotFromBeamFrame(pose))}) {
      EXPECT_NEAR(distanceBetween(back, pose), 0.0, 1e-12);
      EXPECT_EQ(back.phi, pose.phi);
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
