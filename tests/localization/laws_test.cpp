#include "global_localizer.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/CellLocalizer.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

/// What holds for every answer, on random buildings with clutter.
namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

struct Case {
  RangeScan scan;
  TPose2D truth;
};

template <class Check>
void forRandomCases(unsigned seed, std::size_t maps, std::size_t scans, const Check& check) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::uint32_t m = 0; m < maps; ++m) {
    FloorPlanParams plan;
    plan.rooms_per_side = 2;
    plan.furniture_per_room = 2;
    plan.unknown_share = m % 2 == 0 ? 0.0 : 0.4;
    plan.rotation = 0.4 * m;
    const PolygonMap map = floorPlan(plan, m);
    const GlobalLocalizer localizer(map);
    const Triangulation triangulation(map);
    for (const TPoint2D& p : randomFreePoints(map, scans, random)) {
      ScanOptions options;
      options.sigma = 0.03;
      options.short_share = 0.3;
      options.seed = static_cast<std::uint32_t>(random());
      const TPose2D truth{p.x, p.y, kPi * unit(random)};
      check(localizer, triangulation, Case{simulatedScan(map, truth, options), truth}, random);
    }
  }
}

TEST(Laws, NoHypothesisHasItsSensorBehindAWall) {
  forRandomCases(
      21, 4, 25, [](const auto& localizer, const auto& triangulation, const Case& c, auto&) {
        for (const Hypothesis& h : localizer.localize(c.scan).hypotheses) {
          const TPose2D beams = c.scan.beamFrameFromRobot(h.pose_map_robot);
          EXPECT_TRUE(triangulation.isFreeOrBeside({beams.x, beams.y}, AllowedPoses::kBeside))
              << beams.x << " " << beams.y;
        }
      });
}

TEST(Laws, RefinementStaysWhereTheSensorMayBe) {
  // The robot stands in unknown space, a little farther beyond the border than is allowed: all
  // walls are known, so that the scan fits best where it was taken.
  const std::vector<TPoint2D> walls = {{8, 0}, {11, 0}, {11, 5}, {8, 5}};
  Ring border = wallRing({{0, 0}, {8, 0}, {8, 5}, {3, 5}, {3, 4}, {0, 4}});
  border.kinds[1] = EdgeKind::open;
  const PolygonMap map({{border, {}}}, {walls});
  const PolygonMap real = mapOf({{0, 0}, {11, 0}, {11, 5}, {3, 5}, {3, 4}, {0, 4}});
  const Triangulation triangulation(map);
  const RangePredictor predictor(triangulation, RangePredictor::kSquareSize, 1);
  const GlobalLocalizer localizer(map);
  std::mt19937 random(23);
  std::uniform_real_distribution<double> depth(0.72, 0.9), y(1.0, 4.0), angle(-kPi, kPi);
  const auto is_forbidden = [&](const TPose2D& beams) {
    return !triangulation.isFreeOrBeside({beams.x, beams.y}, AllowedPoses::kBeside);
  };
  std::size_t drawn_out = 0;
  for (int i = 0; i < 20; ++i) {
    const TPose2D truth{8.0 + depth(random), y(random), angle(random)};
    const RangeScan scan = simulatedScan(real, truth);
    const TPose2D start{7.9, truth.y, truth.phi};
    drawn_out += is_forbidden(PoseRefiner(predictor, scan).refine(start).pose_map_beams);
    for (const Hypothesis& h : localizer.localize(scan).hypotheses) {
      EXPECT_FALSE(is_forbidden(h.pose_map_robot)) << i;
    }
  }
  EXPECT_GT(drawn_out, 5U);  // else nothing was tested
}

TEST(Laws, ACorrectPriorMakesNoScanUnknownAndIsNeverLeft) {
  std::size_t refused = 0, refused_free = 0, scans = 0;
  forRandomCases(22, 4, 25, [&](const auto& localizer, const auto&, const Case& c, auto& random) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    PosePrior prior;
    // Tight, and the truth at its rim: noise alone draws the best fit out of it.
    const double off = unit(random) < 0.0 ? -0.99 : 0.99;
    prior.compass = PosePrior::Compass{c.truth.phi + 0.01 * off, 0.01};
    prior.near = PosePrior::Disk{c.truth.x + 0.02 * off, c.truth.y, 0.02};
    const auto result = localizer.localize(c.scan, prior);
    ++scans;
    refused += result.status == LocalizationStatus::no_match;
    refused_free += localizer.localize(c.scan).status == LocalizationStatus::no_match;
    for (const Hypothesis& h : result.hypotheses) {
      EXPECT_LE(angleBetween(h.pose_map_robot.phi, prior.compass->heading), 0.01 + 1e-6);
      EXPECT_LE(distanceBetween(h.pose_map_robot, {prior.near->x, prior.near->y, 0}), 0.02 + 1e-6);
    }
  });
  EXPECT_GT(scans, 90U);
  EXPECT_LE(refused, refused_free);
}

TEST(Laws, TheParamsCostIsWhatHypothesesCost) {
  const PolygonMap map = asymmetricRoom();
  const MapIndex::Ptr index = MapIndex::build(map);
  ScanOptions options;
  options.short_share = 0.3;
  const RangeScan scan = simulatedScan(map, {1.5, 2.1, 0.3}, options);
  GlobalLocalizerParams params;
  const double usual = GlobalLocalizer(index, params).localize(scan).hypotheses.at(0).cost;
  params.cost.tau_short = 0.1;
  const double capped = GlobalLocalizer(index, params).localize(scan).hypotheses.at(0).cost;
  EXPECT_LT(capped, 0.5 * usual);
  // And by the evidence's they are weighed: where nothing costs much, nothing is told apart.
  params.hypotheses.evidence.cost = {1e-3, 1e-3, 1e-3, 0.0, 0.8};
  params.hypotheses.evidence.hidden_cost = 0.0;
  params.hypotheses.evidence.off_wall_cost = 0.0;
  const auto blind = GlobalLocalizer(index, params).localize(scan);
  EXPECT_NE(blind.status, LocalizationStatus::unique);
}

TEST(Laws, OnCoarserCellsNoLocalizerIsSurer) {
  // All that tells four poses of a square room apart is a niche.
  const PolygonMap drawn =
      mapOf({{0, 0}, {5, 0}, {5, 2}, {5.4, 2}, {5.4, 2.2}, {5, 2.2}, {5, 5}, {0, 5}});
  const PolygonMap traced(drawn.components(), {}, 2.0);
  const RangeScan scan = simulatedScan(drawn, {1.5, 2.1, 0.3});
  SearchOptions options;
  options.max_hypotheses = 1;
  const auto sureness = [&](const auto& localizer) {
    return localizer.localize(scan, {}, options).hypotheses.at(0).weight;
  };
  EXPECT_LT(sureness(GlobalLocalizer(traced)), sureness(GlobalLocalizer(drawn)) - 0.01);
  EXPECT_LT(sureness(CellLocalizer(traced)), sureness(CellLocalizer(drawn)) - 0.01);
}

TEST(Laws, ASensorThatIsNowhereIsRefused) {
  EXPECT_THROW(RangeScan({}, {std::nan(""), 0.0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
