#include "global_localizer.h"
#include "tests/support/random_maps.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/MapIndex.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <sstream>
#include <thread>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

PolygonMap someFloor() {
  FloorPlanParams plan;
  plan.rooms_per_side = 3;
  plan.furniture_per_room = 2;
  return floorPlan(plan, 2);
}

TEST(MapIndex, DeferredGivesTheSameAnswersAndHoldsNothingUntilAsked) {
  const MapIndex::Ptr built = MapIndex::build(asymmetricRoom());
  const MapIndex::Ptr deferred = MapIndex::deferred(asymmetricRoom());
  EXPECT_EQ(deferred->bytes(), 0U);
  EXPECT_GT(built->bytes(), 10'000U);
  EXPECT_GT(built->buildSeconds(), 0.0);
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 2.1, 0.3});
  const auto a = GlobalLocalizer(built).localize(scan);
  const auto b = GlobalLocalizer(deferred).localize(scan);
  EXPECT_EQ(deferred->bytes(), built->bytes());
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  EXPECT_EQ(a.hypotheses[0].pose_map_robot, b.hypotheses[0].pose_map_robot);
}

TEST(MapIndex, IsSharedByLocalizersOfBothKinds) {
  const MapIndex::Ptr index = MapIndex::deferred(asymmetricRoom());
  const CellLocalizer cells(index);
  const std::size_t without_tree = index->bytes();
  const GlobalLocalizer certified(index);
  EXPECT_GT(index->bytes(), without_tree);  // the tree is added to what is there
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 2.1, 0.3});
  EXPECT_LT(distanceBetween(cells.localize(scan).hypotheses.at(0).pose_map_robot,
                            certified.localize(scan).hypotheses.at(0).pose_map_robot),
            1e-3);
}

TEST(MapIndex, ManyThreadsMayAskForADeferredOneAtOnce) {
  const MapIndex::Ptr index = MapIndex::deferred(someFloor());
  const RangeScan scan = simulatedScan(index->map(), {2.0, 1.5, 0.3});
  std::vector<LocalizationResult> results(4);
  std::vector<std::thread> threads;
  for (LocalizationResult& result : results) {
    threads.emplace_back([&] { result = GlobalLocalizer(index).localize(scan); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const LocalizationResult& result : results) {
    ASSERT_EQ(result.hypotheses.size(), results[0].hypotheses.size());
    EXPECT_EQ(result.statistics.evaluated, results[0].statistics.evaluated);
  }
}

TEST(MapIndex, TellsItsProgressAndCanBeGivenUp) {
  std::vector<double> shares;
  MapIndex::build(someFloor(), {0.25, 1}, [&](double share) {
    shares.push_back(share);
    return true;
  });
  ASSERT_GT(shares.size(), 10U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
  for (const double last : {0.1, 0.6}) {  // while edges are listed, while the tree is built
    EXPECT_THROW(MapIndex::build(someFloor(), {}, [last](double share) { return share < last; }),
                 CancelledError);
  }
}

TEST(MapIndex, MemoryFollowsTheFreeAreaNotTheBox) {
  const auto twoRooms = [](double apart) {
    return PolygonMap({freePolygon(rectangle(0, 0, 5, 4)),
                       freePolygon(rectangle(apart, apart, apart + 6, apart + 4))});
  };
  const MapIndex::Ptr near = MapIndex::build(twoRooms(10.0));
  const MapIndex::Ptr far = MapIndex::build(twoRooms(3000.0));
  EXPECT_LT(far->bytes(), 2 * near->bytes());
  const mrpt::math::TPose2D truth{3002.0, 3001.2, 0.4};
  const auto result = GlobalLocalizer(far).localize(simulatedScan(far->map(), truth));
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_LT(distanceBetween(result.hypotheses[0].pose_map_robot, truth), 0.01);
}

TEST(MapIndex, ChecksNameTheField) {
  const auto complaint = [](const MapIndexParams& params) {
    return messageOf<InvalidParamsError>([&] { MapIndex::build(squareMap(1.0), params); });
  };
  for (const double bad : {0.0, -0.1, 11.0, std::nan("")}) {
    EXPECT_THAT(complaint({bad, 1}), ::testing::HasSubstr("leaf_size"));
  }
  EXPECT_THAT(complaint({0.25, -1}), ::testing::HasSubstr("threads"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
