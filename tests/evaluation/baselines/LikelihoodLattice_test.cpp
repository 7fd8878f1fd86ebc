#include "room.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/Simulator.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/baselines/LikelihoodLattice.h>
#include <mrpt_polyloc/evaluation/baselines/rasterize.h>
#include <mrpt_polyloc/io/observation.h>

#include <gtest/gtest.h>

#include <thread>

namespace mrpt_polyloc {
namespace {

using test::pillarRoom;

std::vector<SimulatedScan> eightScans() {
  SimulatorParams params;
  params.beams = 120;
  params.short_beams = 0.1;
  return simulateScans(pillarRoom(), params, 8, 5);
}

TEST(LikelihoodLattice, FindsWhereScansWereTakenToCentimetres) {
  LikelihoodLatticeParams params;
  params.step = 0.4;
  const LikelihoodLattice lattice(rasterize(pillarRoom(), 0.05), params);
  EXPECT_NEAR(static_cast<double>(lattice.latticePositions()), pillarRoom().area() / 0.16, 20.0);
  for (const SimulatedScan& simulated : eightScans()) {
    const auto answers = lattice.localize(toRangeScan(simulated.observation));
    ASSERT_FALSE(answers.empty());
    EXPECT_TRUE(isRight(answers.front().pose_map_robot, simulated.truth.pose_map_robot,
                        Tolerance{0.1, 0.05}));
    for (std::size_t i = 1; i < answers.size(); ++i) {
      EXPECT_LE(answers[i].score, answers[i - 1].score);
      EXPECT_FALSE(
          isRight(answers[i].pose_map_robot, answers[i - 1].pose_map_robot, Tolerance{0.15, 0.05}));
    }
    EXPECT_LE(answers.front().score, 1.0);
    EXPECT_GE(answers.back().score, 0.0);
  }
}

TEST(LikelihoodLattice, ThreadsDoNotDisturbEachOther) {
  const LikelihoodLattice lattice(rasterize(pillarRoom(), 0.1));
  const auto simulated = eightScans();
  std::vector<std::vector<BaselineAnswer>> alone, together(simulated.size());
  for (const auto& scan : simulated)
    alone.push_back(lattice.localize(toRangeScan(scan.observation)));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    threads.emplace_back(
        [&, i] { together[i] = lattice.localize(toRangeScan(simulated[i].observation)); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    ASSERT_EQ(together[i].size(), alone[i].size());
    EXPECT_EQ(together[i].front().pose_map_robot, alone[i].front().pose_map_robot);
  }
}

TEST(LikelihoodLattice, TurnedMapsAreSeen) {
  OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.05);
  const mrpt::math::TPose2D turned(3, -2, 0.7);
  bitmap.pose_map_bitmap = turned + bitmap.pose_map_bitmap;
  const SimulatedScan simulated = eightScans().front();
  const auto answers = LikelihoodLattice(bitmap).localize(toRangeScan(simulated.observation));
  ASSERT_FALSE(answers.empty());
  EXPECT_TRUE(isRight(answers.front().pose_map_robot, turned + simulated.truth.pose_map_robot));
}

TEST(LikelihoodLattice, RefusesWhatItCannotSearch) {
  OccupancyBitmap bitmap = rasterize(pillarRoom(), 0.1);
  EXPECT_TRUE(LikelihoodLattice(bitmap).localize(RangeScan({})).empty());
  LikelihoodLatticeParams params;
  params.step = -1;
  EXPECT_THROW(LikelihoodLattice(bitmap, params), InvalidParamsError);
  for (CellState& cell : bitmap.cells) cell = CellState::unknown;
  EXPECT_THROW(LikelihoodLattice{bitmap}, InvalidMapError);
}

}  // namespace
}  // namespace mrpt_polyloc
