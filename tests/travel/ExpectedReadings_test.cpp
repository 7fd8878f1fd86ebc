#include "travel_support.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/ExpectedReadings.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

TEST(LaserModel, IsThatOfTheScan) {
  const WallSegments walls(squareMap(10.0));
  const RangeScan around = castScan(walls, {5, 5, 0}, 360, 4.9);
  const LaserModel laser = LaserModel::of(around, 90);
  EXPECT_EQ(laser.bearings.size(), 90u);
  EXPECT_DOUBLE_EQ(laser.max_range, 4.9);
  EXPECT_NEAR(toDegrees(laser.fieldOfView()), 356.0, 1e-6);
  EXPECT_DOUBLE_EQ(LaserModel::of(around, 90, 12.0).max_range, 12.0);

  const LaserModel half = LaserModel::of(castScan(walls, {5, 5, 0}, 181, 30.0, kPi), 1000);
  EXPECT_EQ(half.bearings.size(), 181u);
  EXPECT_NEAR(half.max_range, 5.0 * std::sqrt(2.0), 0.05) << "no no-return: its farthest hit";
  EXPECT_NEAR(toDegrees(half.fieldOfView()), 180.0 * 180 / 181, 1e-6);
}

TEST(ExpectedReadings, HoldWhatIsReadFromAllPosesNearby) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const PolygonMap map = floorPlan(smallFlat(), seed);
    const WallSegments walls(map);
    const RangePredictor predictor(Triangulation(map), 0.5, 1);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::size_t beams = 0, outside = 0;
    for (const TPoint2D& p : randomFreePoints(map, 20, random)) {
      if (signedClearance(map, p) < 0.35) continue;
      Hypothesis hypothesis = hypothesisAt(p.x, p.y, kPi * unit(random), 1.0);
      const double along = kPi * unit(random), deviation = 0.12;
      hypothesis.covariance(0, 0) = std::pow(deviation * std::cos(along), 2);
      hypothesis.covariance(1, 1) = std::pow(deviation * std::sin(along), 2);
      hypothesis.covariance(0, 1) = hypothesis.covariance(1, 0) =
          deviation * deviation * std::cos(along) * std::sin(along);
      const TPose2D moved(0.05 * unit(random), 0.05 * unit(random), kPi * unit(random));
      const RangeScan pattern = castScan(walls, {p.x, p.y, 0}, 120);
      const ReadingExpectation expectation(predictor, LaserModel::of(pattern, 120));
      const ExpectedReadings expected = expectation.at(hypothesis, moved);
      for (int k = 0; k < 5; ++k) {
        const double off = 2.0 * deviation * unit(random);
        const TPoint2D at = inMap(hypothesis, {moved.x, moved.y});
        const TPose2D pose(at.x + off * std::cos(along), at.y + off * std::sin(along),
                           hypothesis.pose_map_robot.phi + moved.phi);
        const RangeScan read = castScan(walls, pose, 120, 1e3);
        for (std::size_t i = 0; i < 120; ++i, ++beams) {
          const auto range = static_cast<float>(read.beams()[i].range);
          outside += range < expected.low[i] || range > expected.high[i];
        }
      }
    }
    // Positions are looked at every 10 cm: what is seen only between two of them may be missed.
    ASSERT_GT(beams, 1000u);
    EXPECT_LT(static_cast<double>(outside), 0.01 * static_cast<double>(beams));
  }
}

TEST(ExpectedReadings, LeaveOpenWhatIsBehindOpenEdges) {
  PolygonMap map = mapOf(rectangle(0, 0, 4, 4));
  std::vector<FreePolygon> components = map.components();
  components[0].outer.kinds[1] = EdgeKind::open;  // x = 4
  map = PolygonMap(components, {{{6, -1}, {6, 5}}});
  const RangePredictor predictor(Triangulation(map), 0.5, 1);
  LaserModel laser;
  laser.bearings = {0.0, kPi};
  const ExpectedReadings expected =
      ReadingExpectation(predictor, laser).at(hypothesisAt(2, 2, 0, 1.0), {0, 0, 0});
  EXPECT_NEAR(expected.low[0], 2.0 - 0.05, 1e-4);
  EXPECT_NEAR(expected.high[0], 4.0 + 0.05, 1e-4);
  EXPECT_NEAR(expected.low[1], 2.0 - 0.05, 1e-4);
  EXPECT_NEAR(expected.high[1], 2.0 + 0.05, 1e-4);
}

TEST(ExpectedReadings, NameBadParameters) {
  const PolygonMap map = squareMap();
  const RangePredictor predictor(Triangulation(map), 0.5, 1);
  LaserModel laser;
  laser.bearings = {0.0};
  ExpectedReadingsParams params;
  params.tolerance = -1.0;
  EXPECT_THROW(ReadingExpectation(predictor, laser, params), InvalidParamsError);
  laser.max_range = 0.0;
  EXPECT_THROW(ReadingExpectation(predictor, laser), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
