#include "room.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/evaluation/baselines/ParticleFilterBaseline.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>
#include <mrpt_polyloc/io/observation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;
using test::pillarRoom;

/// A drive through the room, from right to left and around the pillar, in its true poses.
std::vector<TPose2D> way() {
  std::vector<TPose2D> poses;
  for (int i = 0; i < 12; ++i) {
    poses.emplace_back(5.2 - 0.35 * i, 2.4 + 0.3 * std::sin(0.5 * i), 2.8 + 0.1 * i);
  }
  return poses;
}

/// What is seen along it. \param sensor place of the laser on the robot
ScanSet drive(const TPoint2D& sensor = {0, 0}) {
  const WallSegments walls(pillarRoom());
  SimulatorParams params;
  params.beams = 120;
  const std::vector<TPose2D> poses = way();
  std::vector<Moment> moments;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const TPose2D eye = poses[i] + TPose2D(sensor.x, sensor.y, 0.0);
    Moment moment;
    const RangeScan seen = toRangeScan(simulateScan(walls, params, eye, 10 + i));
    moment.scans.emplace_back(seen.beams(), sensor);
    if (i > 0) moment.since_before = measuredMotion(poses[i] - poses[i - 1]);
    moments.push_back(moment);
  }
  return ScanSet(moments);
}

TEST(ParticleFilterBaseline, KnowsAfterADriveWhereItIs) {
  const ParticleFilterBaseline filter(rasterize(pillarRoom(), 0.05));
  EXPECT_GT(filter.bytes(), 0u);
  std::size_t right = 0;
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    const auto answers = filter.localize(drive(), seed);
    ASSERT_FALSE(answers.empty());
    right += isRight(answers.front().pose_map_robot, way().back());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_GE(answers[i].score, 0.0);
      EXPECT_LE(answers[i].score, 1.0);
      EXPECT_LE(answers[i].score, i > 0 ? answers[i - 1].score : 1.0);
    }
  }
  EXPECT_GE(right, 3u);  // it is a matter of luck: that is what it is compared for
}

TEST(ParticleFilterBaseline, OneScanLeavesHeapsOfWhichOneIsRight) {
  const ParticleFilterBaseline filter(rasterize(pillarRoom(), 0.05));
  const ScanSet whole = drive();
  const auto answers = filter.localize(ScanSet(whole.moments().front().scans), 5);
  ASSERT_GT(answers.size(), 1u);
  EXPECT_TRUE(std::any_of(answers.begin(), answers.end(), [](const BaselineAnswer& answer) {
    return isRight(answer.pose_map_robot, way().front(), Tolerance{0.5, 15 * kDegree});
  }));
}

TEST(ParticleFilterBaseline, TheSameSeedGivesTheSameAnswersInAnyThread) {
  const ParticleFilterBaseline filter(rasterize(pillarRoom(), 0.1));
  const auto alone = filter.localize(drive(), 7);
  EXPECT_NE(filter.localize(drive(), 8).front().pose_map_robot, alone.front().pose_map_robot);
  std::vector<std::vector<BaselineAnswer>> together(3);
  std::vector<std::thread> threads;
  for (auto& answers : together) {
    threads.emplace_back([&] { answers = filter.localize(drive(), 7); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answers : together) {
    ASSERT_EQ(answers.size(), alone.size());
    EXPECT_EQ(answers.front().pose_map_robot, alone.front().pose_map_robot);
  }
}

TEST(ParticleFilterBaseline, TurnedMapsAndSensorsThatAreOffTheRobotAreSeen) {
  OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.05);
  const TPose2D turned(3, -2, 0.7);
  bitmap.pose_map_bitmap = turned + bitmap.pose_map_bitmap;
  const ParticleFilterBaseline filter(bitmap);
  std::size_t right = 0;
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    right += isRight(filter.localize(drive({0.3, 0.1}), seed).front().pose_map_robot,
                     turned + way().back());
  }
  EXPECT_GE(right, 3u);
}

TEST(ParticleFilterBaseline, RefusesWhatItCannotRun) {
  OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.1);
  EXPECT_TRUE(ParticleFilterBaseline(bitmap).localize(ScanSet(RangeScan({})), 1).empty());
  ParticleFilterBaselineParams params;
  params.particles = 0;
  EXPECT_THROW(ParticleFilterBaseline(bitmap, params), InvalidParamsError);
  for (CellState& cell : bitmap.cells) cell = CellState::occupied;
  EXPECT_THROW(ParticleFilterBaseline{bitmap}, InvalidMapError);
  for (CellState& cell : bitmap.cells) cell = CellState::free;
  EXPECT_THROW(ParticleFilterBaseline{bitmap}, InvalidMapError);
}

}  // namespace
}  // namespace mrpt_polyloc
