#include "room.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/baselines/CorrelativeMatcher.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>
#include <mrpt_polyloc/io/observation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using test::pillarRoom;

std::vector<SimulatedScan> scans(std::size_t count, double short_beams) {
  SimulatorParams params;
  params.beams = 60;
  params.short_beams = short_beams;
  return simulateScans(pillarRoom(), params, count, 8);
}

TEST(CorrelativeMatcher, LevelsAreBoundsOfAllPositionsOfTheirBlocks) {
  const OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.1);
  CorrelativeMatcherParams params;
  params.levels = 4;
  const CorrelativeMatcher matcher(bitmap, params);
  Random random(2);
  const RangeScan scan = toRangeScan(scans(1, 0.2).front().observation);
  const auto hits = matcher.scoredHits(scan);
  for (int trial = 0; trial < 300; ++trial) {
    const auto offsets = matcher.offsets(hits, random.uniform(-kPi, kPi));
    const int level = static_cast<int>(random.uniform(1, 4.999));
    const int column = static_cast<int>(random.uniform(-20, bitmap.width));
    const int row = static_cast<int>(random.uniform(-20, bitmap.height));
    std::uint32_t most = 0;
    for (int y = 0; y < 1 << level; ++y) {
      for (int x = 0; x < 1 << level; ++x) {
        most = std::max(most, matcher.sum(0, offsets, column + x, row + y));
      }
    }
    ASSERT_GE(matcher.sum(level, offsets, column, row), most) << trial;
  }
}

TEST(CorrelativeMatcher, FindsTheGreatestScoreOfTheWholeLattice) {
  const OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.2);
  CorrelativeMatcherParams params;
  params.levels = 3;
  const CorrelativeMatcher matcher(bitmap, params);
  for (const SimulatedScan& simulated : scans(4, 0.5)) {
    const RangeScan scan = toRangeScan(simulated.observation);
    const auto hits = matcher.scoredHits(scan);
    const auto headings = static_cast<std::size_t>(std::ceil(kTwoPi / matcher.angularStep(hits)));
    std::uint32_t most = 0;
    for (std::size_t h = 0; h < headings; ++h) {
      const auto offsets =
          matcher.offsets(hits, kTwoPi * static_cast<double>(h) / static_cast<double>(headings));
      for (int row = 0; row < bitmap.height; ++row) {
        for (int column = 0; column < bitmap.width; ++column) {
          most = std::max(most, matcher.sum(0, offsets, column, row));
        }
      }
    }
    const auto answer = matcher.localize(scan);
    ASSERT_TRUE(answer);
    EXPECT_DOUBLE_EQ(answer->score, most / (255.0 * static_cast<double>(hits.size())));
  }
}

TEST(CorrelativeMatcher, TheAngularStepMovesTheFarthestHitByACell) {
  const CorrelativeMatcher matcher(rasterize(pillarRoom(), 0.05));
  const double step = matcher.angularStep({{1, 0}, {0, 5}});
  EXPECT_NEAR(2 * 5 * std::sin(step / 2), 0.05, 1e-9);
}

TEST(CorrelativeMatcher, FindsWhereScansWereTaken) {
  const CorrelativeMatcher matcher(rasterize(pillarRoom(), 0.05));
  std::size_t right = 0;
  for (const SimulatedScan& simulated : scans(10, 0.1)) {
    const auto answer = matcher.localize(toRangeScan(simulated.observation));
    ASSERT_TRUE(answer);
    right += isRight(answer->pose_map_robot, simulated.truth.pose_map_robot);
  }
  EXPECT_EQ(right, 10u);
}

TEST(CorrelativeMatcher, MapsThatAreTurnedAndSensorsThatAreOffTheRobotAreSeen) {
  OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.05);
  const mrpt::math::TPose2D turned(3, -2, 0.7);  // where the room's frame lies in the map's
  bitmap.pose_map_bitmap = turned + bitmap.pose_map_bitmap;
  const CorrelativeMatcher matcher(bitmap);
  const SimulatedScan simulated = scans(1, 0.0).front();
  const RangeScan scan = toRangeScan(simulated.observation);
  const RangeScan forward(scan.beams(), {0.4, 0.1});  // the same beams from a sensor ahead
  const auto answer = matcher.localize(forward);
  ASSERT_TRUE(answer);
  const mrpt::math::TPose2D eye = turned + simulated.truth.pose_map_robot;
  EXPECT_TRUE(isRight(answer->pose_map_robot, forward.robotFromBeamFrame(eye)));
}

TEST(CorrelativeMatcher, RefusesWhatItCannotSearch) {
  OccupancyBitmap empty = rasterize(pillarRoom(), 0.1);
  EXPECT_FALSE(CorrelativeMatcher(empty).localize(RangeScan({})));
  for (CellState& cell : empty.cells) cell = CellState::free;
  EXPECT_THROW(CorrelativeMatcher{empty}, InvalidMapError);
  CorrelativeMatcherParams params;
  params.sigma = 0;
  EXPECT_THROW(CorrelativeMatcher(rasterize(pillarRoom(), 0.1), params), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
