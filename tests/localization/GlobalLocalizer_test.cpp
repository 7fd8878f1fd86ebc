#include "expect_pose.h"
#include "global_localizer.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// Equal but for the times.
void expectSame(const LocalizationResult& a, const LocalizationResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.statistics.positions, b.statistics.positions);
  EXPECT_EQ(a.statistics.evaluated, b.statistics.evaluated);
  EXPECT_EQ(a.statistics.refined, b.statistics.refined);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    const Hypothesis &x = a.hypotheses[i], &y = b.hypotheses[i];
    EXPECT_EQ(x.pose_map_robot, y.pose_map_robot);
    EXPECT_EQ(x.covariance, y.covariance);
    EXPECT_EQ(x.weight, y.weight);
    EXPECT_EQ(x.cost, y.cost);
  }
}

TEST_F(InAsymmetricRoom, ACleanScanHasOnePose) {
  for (const TPose2D& truth :
       {TPose2D(1.52, 2.13, 0.3), TPose2D(6.3, 1.1, -2.0), TPose2D(3.71, 4.46, kPi)}) {
    const auto result = localizer().localize(simulatedScan(asymmetricRoom(), truth));
    EXPECT_EQ(result.status, LocalizationStatus::unique);
    expectFirstIs(result, truth);
    expectConsistent(result);
    EXPECT_LT(result.hypotheses[0].cost, 0.01);
  }
}

TEST_F(InAsymmetricRoom, StatisticsAndIndexSayWhatWasDone) {
  const auto result = localizer().localize(simulatedScan(asymmetricRoom(), {1.5, 2, 0.3}));
  // 29.08 m2 in leaves of a quarter of a metre, and pieces of them along the borders.
  const double squares = localizer().map().area() / (0.25 * 0.25);
  EXPECT_GE(static_cast<double>(result.statistics.positions), squares);
  EXPECT_LT(static_cast<double>(result.statistics.positions), 1.3 * squares);
  EXPECT_GT(result.statistics.evaluated, 0U);
  EXPECT_GT(result.statistics.refined, 0U);
  EXPECT_LE(result.statistics.refined, CertifiedSearchParams{}.max_candidates);
  EXPECT_GT(result.statistics.search_ms, 0.0);
  EXPECT_GT(result.statistics.refinement_ms, 0.0);
  EXPECT_EQ(localizer().map().hash(), asymmetricRoom().hash());
}

TEST_F(InAsymmetricRoom, NoiseAndObstaclesAreBorne) {
  ScanOptions options;
  options.sigma = 0.02;
  options.short_share = 0.25;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    options.seed = seed;
    const TPose2D truth(4.4, 1.0 + 0.3 * seed, 1.1);
    const auto result = localizer().localize(simulatedScan(asymmetricRoom(), truth, options));
    expectFirstIs(result, truth, 0.05);
    expectConsistent(result);
  }
}

TEST_F(InAsymmetricRoom, HalfACircleIsEnoughHere) {
  ScanOptions options;
  options.field_of_view = kPi;
  options.beams = 180;
  const TPose2D truth(1.2, 1.1, 0.5);
  const auto result = localizer().localize(simulatedScan(asymmetricRoom(), truth, options));
  expectFirstIs(result, truth);
  expectConsistent(result);
}

TEST_F(InAsymmetricRoom, ThePoseIsTheRobotsNotItsSensors) {
  ScanOptions options;
  options.sensor = {0.6, -0.35};
  const TPose2D truth(2.5, 1.4, 0.8);
  const auto result = localizer().localize(simulatedScan(asymmetricRoom(), truth, options));
  EXPECT_EQ(result.status, LocalizationStatus::unique);
  expectFirstIs(result, truth);
}

TEST_F(InAsymmetricRoom, ThePriorHoldsForTheRobot) {
  ScanOptions options;
  options.sensor = {0.6, -0.35};
  const TPose2D truth(2.5, 1.4, 0.8);
  const RangeScan scan = simulatedScan(asymmetricRoom(), truth, options);
  PosePrior prior;
  prior.near = PosePrior::Disk{2.5, 1.4, 0.15};  // the sensor is not within
  prior.compass = PosePrior::Compass{0.8, 0.05};
  expectFirstIs(localizer().localize(scan, prior), truth);
}

TEST_F(InAsymmetricRoom, AWrongPriorNeverGivesAPoseOutsideIt) {
  const TPose2D truth(1.5, 2, 0.3);
  const RangeScan scan = simulatedScan(asymmetricRoom(), truth);
  PosePrior compass;
  for (const double off : {0.3, 1.0, 2.0, kPi}) {
    compass.compass = PosePrior::Compass{truth.phi + off, 0.1};
    const auto result = localizer().localize(scan, compass);
    expectConsistent(result);
    EXPECT_FALSE(holdsPose(result, truth));
    for (const Hypothesis& h : result.hypotheses) {
      EXPECT_LE(turnBetween(h.pose_map_robot, {0, 0, truth.phi + off}), 0.1 + 1e-6);
    }
  }
  PosePrior near;
  for (const TPoint2D& center : {TPoint2D(2.2, 2), TPoint2D(3, 1), TPoint2D(4, 5)}) {
    near.near = PosePrior::Disk{center.x, center.y, 0.4};
    const auto result = localizer().localize(scan, near);
    expectConsistent(result);
    EXPECT_FALSE(holdsPose(result, truth));
    for (const Hypothesis& h : result.hypotheses) {
      EXPECT_LE(distanceBetween(h.pose_map_robot, {center.x, center.y, 0}), 0.4 + 1e-6);
    }
  }
}

TEST_F(InAsymmetricRoom, SeveralThreadsGetTheSameAnswers) {
  std::vector<RangeScan> scans;
  for (int i = 0; i < 4; ++i) {
    scans.push_back(simulatedScan(asymmetricRoom(), {1.0 + 0.4 * i, 1.5, 0.8 * i}));
  }
  std::vector<LocalizationResult> alone, together(2 * scans.size());
  for (const RangeScan& scan : scans) alone.push_back(localizer().localize(scan));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < together.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = localizer().localize(scans[i % scans.size()]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < together.size(); ++i) {
    expectSame(together[i], alone[i % scans.size()]);
  }
}

TEST(GlobalLocalizer, AnswersDoNotDependOnThreadsOrTheRun) {
  FloorPlanParams plan;
  plan.rooms_per_side = 2;
  plan.furniture_per_room = 2;
  plan.unknown_share = 0.5;
  const PolygonMap map = floorPlan(plan, 3);
  const GlobalLocalizer a(MapIndex::build(map, {0.25, 1})), b(MapIndex::build(map, {0.25, 2}));
  std::mt19937 random(3);
  ScanOptions options;
  options.sigma = 0.02;
  options.short_share = 0.2;
  for (const TPoint2D& p : randomFreePoints(map, 4, random)) {
    const RangeScan scan = simulatedScan(map, {p.x, p.y, 0.4}, options);
    const auto first = a.localize(scan);
    expectSame(first, a.localize(scan));
    expectSame(first, b.localize(scan));
  }
}

TEST(GlobalLocalizer, OneAnswerIsTheSameOnAnyNumberOfThreads) {
  FloorPlanParams plan;
  plan.rooms_per_side = 2;
  plan.furniture_per_room = 2;
  plan.unknown_share = 0.5;
  const PolygonMap map = floorPlan(plan, 4);
  const GlobalLocalizer localizer(map);
  std::mt19937 random(4);
  ScanOptions kind;
  kind.sigma = 0.02;
  kind.short_share = 0.2;
  SearchOptions options;
  options.keep_regions = true;
  std::vector<RangeScan> scans;
  std::vector<LocalizationResult> expected;
  for (const TPoint2D& p : randomFreePoints(map, 4, random)) {
    kind.seed = static_cast<std::uint32_t>(random());
    scans.push_back(simulatedScan(map, {p.x, p.y, 0.4}, kind));
    expected.push_back(localizer.localize(scans.back(), {}, options));
  }
  const auto expect_same = [&](const LocalizationResult& found, std::size_t i) {
    expectSame(found, expected[i]);
    ASSERT_TRUE(found.certificate && expected[i].certificate);
    const Certificate &a = *found.certificate, &b = *expected[i].certificate;
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_EQ(a.least, b.least);
    EXPECT_EQ(a.at_least, b.at_least);
    EXPECT_EQ(a.settled.bounded, b.settled.bounded);
    EXPECT_EQ(a.settled.distant, b.settled.distant);
    EXPECT_EQ(a.settled.lowered, b.settled.lowered);
    EXPECT_EQ(a.settled.drained, b.settled.drained);
    ASSERT_EQ(found.regions.size(), expected[i].regions.size());
    for (std::size_t k = 0; k < found.regions.size(); ++k) {
      EXPECT_EQ(found.regions[k].polygon, expected[i].regions[k].polygon);
      EXPECT_EQ(found.regions[k].bound, expected[i].regions[k].bound);
    }
  };
  const tbb::global_control three(tbb::global_control::max_allowed_parallelism, 3);
  for (const int threads : {0, 2, 3}) {
    SCOPED_TRACE(threads);
    options.threads = threads;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      expect_same(localizer.localize(scans[i], {}, options), i);
    }
    // And several at once, each on all threads that are free.
    const std::vector<LocalizationResult> together = localizer.localize(scans, {}, options);
    for (std::size_t i = 0; i < scans.size(); ++i) expect_same(together[i], i);
  }
}

class InASquareRoom : public ::testing::Test {
 protected:
  PolygonMap map_ = squareMap(5.0);
  TPose2D truth_{1.4, 1.9, 0.35};
  RangeScan scan_ = simulatedScan(map_, truth_);

  /// The pose after quarter turns about the room's middle.
  TPose2D turned(int quarters) const {
    const double c = std::cos(quarters * kPi / 2), s = std::sin(quarters * kPi / 2);
    const double x = truth_.x - 2.5, y = truth_.y - 2.5;
    return {2.5 + c * x - s * y, 2.5 + s * x + c * y, truth_.phi + quarters * kPi / 2};
  }
};

TEST_F(InASquareRoom, AllFourPosesAreFound) {
  const auto result = GlobalLocalizer(map_).localize(scan_);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  expectConsistent(result);
  ASSERT_GE(result.hypotheses.size(), 4U);
  LocalizationResult first_four = result;
  first_four.hypotheses.resize(4);
  for (int quarters = 0; quarters < 4; ++quarters) {
    EXPECT_TRUE(holdsPose(first_four, turned(quarters))) << quarters;
  }
  EXPECT_NEAR(result.hypotheses[0].weight, result.hypotheses[3].weight, 0.01);
}

TEST_F(InASquareRoom, ItStaysAmbiguousIfOnlyOneHypothesisIsAskedFor) {
  SearchOptions options;
  options.max_hypotheses = 1;
  const auto result = GlobalLocalizer(map_).localize(scan_, {}, options);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  ASSERT_EQ(result.hypotheses.size(), 1U);
  EXPECT_NEAR(result.hypotheses[0].weight, 0.25, 0.05);  // of all four
  EXPECT_EQ(result.listed, result.hypotheses[0].weight);
}

TEST_F(InASquareRoom, ACompassTellsTheFourApart) {
  const GlobalLocalizer localizer(map_);
  for (int quarters = 0; quarters < 4; ++quarters) {
    PosePrior prior;
    prior.compass = PosePrior::Compass{turned(quarters).phi + 0.2, 0.4};
    const auto result = localizer.localize(scan_, prior);
    EXPECT_EQ(result.status, LocalizationStatus::unique);
    expectFirstIs(result, turned(quarters));
  }
}

TEST_F(InASquareRoom, ADiskTellsTheFourApart) {
  const GlobalLocalizer localizer(map_);
  for (int quarters = 0; quarters < 4; ++quarters) {
    PosePrior prior;
    prior.near = PosePrior::Disk{turned(quarters).x + 0.1, turned(quarters).y, 0.4};
    const auto result = localizer.localize(scan_, prior);
    EXPECT_EQ(result.status, LocalizationStatus::unique);
    expectFirstIs(result, turned(quarters));
  }
}

TEST(GlobalLocalizer, OnRandomBuildingsTheTruthIsAmongTheAnswers) {
  int found = 0, scans = 0;
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    FloorPlanParams plan;
    plan.rooms_per_side = 2;
    plan.furniture_per_room = 3;
    plan.rotation = 0.3 * seed;
    plan.offset = {100.0 * seed, -50.0};
    const PolygonMap map = floorPlan(plan, seed);
    const GlobalLocalizer localizer(map);
    std::mt19937 random(seed);
    ScanOptions options;
    options.sigma = 0.01;
    for (const TPoint2D& p : randomFreePoints(map, 10, random)) {
      const TPose2D truth(p.x, p.y, std::uniform_real_distribution<double>(-3, 3)(random));
      const auto result = localizer.localize(simulatedScan(map, truth, options));
      expectConsistent(result);
      found += holdsPose(result, truth);
      ++scans;
    }
  }
  EXPECT_GE(found, scans - 1);
}

TEST(GlobalLocalizer, ATinyRoomOfANarrowMap) {
  const PolygonMap map({freePolygon(rectangle(0, 0, 6, 4)),
                        freePolygon(rectangle(6.52, 1, 6.57, 1.06)),  // smaller than a leaf
                        freePolygon(rectangle(8, 0, 8.4, 0.3))});
  // Walls 0.3 m apart hold a heading badly, as chance fits do: here the search alone is asked.
  GlobalLocalizerParams params;
  params.hypotheses.calibration.least_match_probability = 0.0;
  const GlobalLocalizer localizer(map, params);
  const TPose2D truth(8.18, 0.14, 0.2);
  const auto result = localizer.localize(simulatedScan(map, truth));
  expectConsistent(result);
  EXPECT_TRUE(holdsPose(result, truth));
}

TEST(GlobalLocalizer, CanBeReplacedAndSharesItsIndex) {
  const MapIndex::Ptr index = MapIndex::build(squareMap(2.0));
  GlobalLocalizer localizer(asymmetricRoom());
  localizer = GlobalLocalizer(index);
  const GlobalLocalizer copy = localizer;
  EXPECT_EQ(&copy.index(), index.get());
  const RangeScan scan = simulatedScan(copy.map(), {0.7, 1.1, 0});
  expectConsistent(localizer.localize(scan));
  expectSame(localizer.localize(scan), copy.localize(scan));
  EXPECT_THROW(GlobalLocalizer(MapIndex::Ptr()), InvalidParamsError);
}

TEST(GlobalLocalizer, ABatchGivesWhatSingleScansGive) {
  const GlobalLocalizer localizer(asymmetricRoom());
  std::vector<RangeScan> scans;
  for (int i = 0; i < 9; ++i) {
    scans.push_back(simulatedScan(asymmetricRoom(), {1.0 + 0.2 * i, 1.2, 0.7 * i}));
  }
  const auto all = localizer.localize(scans);
  ASSERT_EQ(all.size(), scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) expectSame(all[i], localizer.localize(scans[i]));
}

TEST(GlobalLocalizer, ACancelledCallIsNeverUnique) {
  const GlobalLocalizer localizer(asymmetricRoom());
  const RangeScan scan = simulatedScan(asymmetricRoom(), {1.5, 2.1, 0.3});
  const std::atomic<bool> cancelled{true};
  SearchOptions options;
  options.cancel = &cancelled;
  const auto result = localizer.localize(scan, {}, options);
  EXPECT_FALSE(result.certificate);
  EXPECT_NE(result.status, LocalizationStatus::unique);
}

TEST(LocalizationStatus, HasAName) {
  EXPECT_STREQ(toString(LocalizationStatus::unique), "unique");
  EXPECT_STREQ(toString(LocalizationStatus::ambiguous), "ambiguous");
  EXPECT_STREQ(toString(LocalizationStatus::no_match), "no_match");
  EXPECT_STREQ(toString(LocalizationStatus::too_few_beams), "too_few_beams");
}

}  // namespace
}  // namespace mrpt_polyloc::test
