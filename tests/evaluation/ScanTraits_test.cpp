#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/evaluation/ScanTraits.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

/// A room of 6 m x 4 m whose right side is open to the unknown, with a wall 2 m behind it.
PolygonMap halfOpenRoom() {
  Ring outer = wallRing({{0, 0}, {6, 0}, {6, 4}, {0, 4}});
  outer.kinds[1] = EdgeKind::open;
  return PolygonMap({{outer, {}}}, {{{8, -3}, {8, 7}}});
}

RangeScan scanOf(const std::vector<double>& ranges, double fov) {
  std::vector<Beam> beams;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double bearing =
        -0.5 * fov + fov * static_cast<double>(i) / static_cast<double>(ranges.size() - 1);
    beams.push_back(
        {bearing, ranges[i], std::isfinite(ranges[i]) ? BeamKind::hit : BeamKind::invalid});
  }
  return RangeScan(std::move(beams));
}

TEST(ScanTraits, CountsWhatDisagreesAsBruteForceDoes) {
  const PolygonMap map = halfOpenRoom();
  const ScanJudge judge(map);
  const WallSegments walls(map);
  Random random(4);
  for (int trial = 0; trial < 50; ++trial) {
    const mrpt::math::TPose2D pose(random.uniform(0.5, 5.5), random.uniform(0.5, 3.5),
                                   random.uniform(-kPi, kPi));
    std::vector<double> ranges;
    std::size_t before = 0, passed = 0;
    constexpr std::size_t kBeams = 181;
    for (std::size_t i = 0; i < kBeams; ++i) {
      const double direction = pose.phi - kPi / 2 + kPi * static_cast<double>(i) / (kBeams - 1);
      const double wall = walls.range({pose.x, pose.y}, direction);
      const double open = std::cos(direction) > 0 ? (6.0 - pose.x) / std::cos(direction) : 1e9;
      const double y = pose.y + open * std::sin(direction);
      const double shown = open < 1e6 && y > 0 && y < 4 ? std::min(open, wall) : wall;
      const double off = random.uniform(-1.0, 1.0);
      if (!std::isfinite(wall) || std::abs(std::abs(off) - 0.3) < 0.01) {
        ranges.push_back(std::numeric_limits<double>::infinity());
        continue;
      }
      // Around the wall, or, half of the time, around where free space ends.
      const double range = std::max(0.05, (i % 2 == 0 ? wall : shown) + off);
      ranges.push_back(range);
      before += range < shown - 0.3;
      passed += range > wall + 0.3;
    }
    const ScanTraits traits = judge.traits(scanOf(ranges, kPi), pose);
    const auto hits = static_cast<double>(traits.hits);
    EXPECT_NEAR(traits.clutter, static_cast<double>(before) / hits, 1.5 / hits) << trial;
    EXPECT_NEAR(traits.passed, static_cast<double>(passed) / hits, 1.5 / hits) << trial;
    EXPECT_EQ(traits.outside, 0.0);
  }
}

TEST(ScanTraits, TellsHowFarOutsideOfFreeSpaceTheSensorIs) {
  const PolygonMap map = halfOpenRoom();
  const ScanJudge judge(map);
  const RangeScan scan({{0.0, 1.0, BeamKind::hit}}, {0.5, 0.0});
  EXPECT_NEAR(judge.traits(scan, {6.2, 2, 0}).outside, 0.7, 1e-9);    // the sensor is at 6.7
  EXPECT_NEAR(judge.traits(scan, {6.2, 2, kPi}).outside, 0.0, 1e-9);  // and here at 5.7
  EXPECT_NEAR(judge.traits(scan, {8.5, 8, 0}).outside, 5.0, 1e-9);
}

TEST(ScanTraits, FieldOfViewIsTheCircleWithoutItsGap) {
  const PolygonMap map = halfOpenRoom();
  const ScanJudge judge(map);
  const auto fov = [&](const RangeScan& scan) { return judge.traits(scan, {3, 2, 0}).fov; };
  EXPECT_NEAR(fov(scanOf(std::vector<double>(91, 1.0), kPi / 2)), kPi / 2, 1e-9);
  EXPECT_NEAR(fov(RangeScan({{3.0, 1, BeamKind::hit}, {-3.0, 1, BeamKind::hit}})), kTwoPi - 6.0,
              1e-9);
  EXPECT_EQ(fov(RangeScan({})), 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc
