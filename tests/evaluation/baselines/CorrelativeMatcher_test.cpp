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

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

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

/// Whether a free cell's middle is near that of a cell, by looking at all cells.
bool isNearFree(const OccupancyBitmap& bitmap, int column, int row, double distance) {
  for (int y = 0; y < bitmap.height; ++y) {
    for (int x = 0; x < bitmap.width; ++x) {
      if (bitmap.at(x, y) == CellState::free &&
          bitmap.resolution * std::hypot(x - column, y - row) <= distance + 1e-9) {
        return true;
      }
    }
  }
  return false;
}

/// A number of levels, and how far beside free cells is searched [m].
using Search = std::pair<int, double>;

class CorrelativeMatcherSearch : public testing::TestWithParam<Search> {};

INSTANTIATE_TEST_SUITE_P(Levels, CorrelativeMatcherSearch,
                         testing::Values(Search{3, 0.0}, Search{0, 0.3}, Search{5, 0.3},
                                         Search{2, std::numeric_limits<double>::infinity()}));

TEST_P(CorrelativeMatcherSearch, FindsTheGreatestScoreOfTheWholeLattice) {
  const OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.2);
  CorrelativeMatcherParams params;
  std::tie(params.levels, params.beyond_free) = GetParam();
  params.most_hits = 30;  // of some 50: they are thinned
  const CorrelativeMatcher matcher(bitmap, params);
  for (const SimulatedScan& simulated : scans(3, 0.5)) {
    const RangeScan scan = toRangeScan(simulated.observation);
    const auto hits = matcher.scoredHits(scan);
    const auto headings = static_cast<std::size_t>(std::ceil(kTwoPi / matcher.angularStep(hits)));
    std::uint32_t most = 0;
    for (std::size_t h = 0; h < headings; ++h) {
      const auto offsets =
          matcher.offsets(hits, kTwoPi * static_cast<double>(h) / static_cast<double>(headings));
      for (int row = 0; row < bitmap.height; ++row) {
        for (int column = 0; column < bitmap.width; ++column) {
          if (!isNearFree(bitmap, column, row, params.beyond_free)) continue;
          most = std::max(most, matcher.sum(0, offsets, column, row));
        }
      }
    }
    const auto answer = matcher.localize(scan);
    ASSERT_TRUE(answer);
    EXPECT_DOUBLE_EQ(answer->score, most / (255.0 * static_cast<double>(hits.size())));
  }
}

TEST(CorrelativeMatcher, BlocksAreSearchedThatHaveACellToLookIn) {
  const OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.1);
  CorrelativeMatcherParams params;
  params.levels = 4;
  params.beyond_free = 0.35;  // no cell is exactly so far away
  const CorrelativeMatcher matcher(bitmap, params);
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const bool is_near = isNearFree(bitmap, column, row, params.beyond_free);
      ASSERT_EQ(matcher.isSearched(0, column, row), is_near);
      for (int level = 1; is_near && level <= params.levels; ++level) {
        const int side = 1 << level;
        ASSERT_TRUE(matcher.isSearched(level, column / side * side, row / side * side));
      }
    }
  }
  EXPECT_FALSE(matcher.isSearched(0, bitmap.width, 0));
}

TEST(CorrelativeMatcher, HitsAreThinnedEvenlyInSpace) {
  CorrelativeMatcherParams params;
  params.most_hits = 50;
  const CorrelativeMatcher matcher(rasterize(pillarRoom(), 0.1), params);
  // A wall 1 m ahead and one 8 m behind: by angle most hits are of the near one.
  std::vector<Beam> beams;
  for (int i = -150; i <= 150; ++i) {
    const double bearing = 0.5 * i * kDegree / 1.7, near = 1.0 / std::cos(bearing);
    beams.push_back({bearing, near, BeamKind::hit});
    beams.push_back({kPi + bearing, 8.0 * near, BeamKind::hit});
  }
  const auto hits = matcher.scoredHits(RangeScan(beams));
  EXPECT_GE(hits.size(), 50u);
  EXPECT_LE(hits.size(), 75u);
  const auto near = std::count_if(hits.begin(), hits.end(), [](const auto& p) { return p.x > 0; });
  EXPECT_GT(near, 3);
  EXPECT_LT(near, static_cast<std::ptrdiff_t>(hits.size() / 4));  // an eighth of the length
  // As few as are asked for are all taken.
  beams.resize(50);
  EXPECT_EQ(matcher.scoredHits(RangeScan(beams)).size(), 50u);
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
  for (CellState& cell : empty.cells) cell = CellState::occupied;
  EXPECT_THROW(CorrelativeMatcher{empty}, InvalidMapError);
  CorrelativeMatcherParams params;
  params.beyond_free = -1;
  EXPECT_THROW(CorrelativeMatcher(rasterize(pillarRoom(), 0.1), params), InvalidParamsError);
  params = {};
  params.sigma = 0;
  EXPECT_THROW(CorrelativeMatcher(rasterize(pillarRoom(), 0.1), params), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
