#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

TEST(ScanCost, IsTheMeanOfTheRuleOverTheRangesByBruteForce) {
  std::mt19937 random(3);
  FloorPlanParams params;
  params.rooms_per_side = 2;
  params.unknown_share = 1.0;
  const PolygonMap map = floorPlan(params, 1);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const BruteForceRays rays(map);
  const RobustCost rule;
  const auto points = randomFreePoints(map, 20, random);
  for (std::size_t i = 1; i < points.size(); ++i) {
    ScanOptions options;
    options.max_range = 4.0;
    const RangeScan scan = simulatedScan(map, {points[i - 1].x, points[i - 1].y, 0.2}, options);
    const mrpt::math::TPose2D pose(points[i].x, points[i].y, 1.1);
    double sum = 0.0;
    for (const Beam& beam : scan.beams()) {
      const RayHit hit = rays.cast(points[i], pose.phi + beam.bearing);
      sum += static_cast<double>(
          rule(beam, static_cast<float>(hit.wall), static_cast<float>(hit.open)));
    }
    const ScanCost cost(predictor, scan, {});
    // A grazing beam or two may differ by their caps.
    EXPECT_NEAR(cost.mean(pose), sum / static_cast<double>(scan.beams().size()), 2 * 0.6 / 360);
  }
}

TEST(ScanCost, LeavesInvalidBeamsOutAndKeepsTheOrder) {
  const PolygonMap map = squareMap(4.0);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const RangeScan scan({{kPi / 2, 1.75, BeamKind::hit},
                        {0.0, std::nan(""), BeamKind::hit},
                        {0.0, 2.0, BeamKind::hit},
                        {kPi, 10.0, BeamKind::no_return}});
  const ScanCost cost(predictor, scan, {});
  EXPECT_EQ(cost.beamCount(), 3U);
  const auto costs = cost.perBeam({2, 2, 0});
  ASSERT_EQ(costs.size(), 3U);
  EXPECT_NEAR(costs[0], 0.25, 1e-5);
  EXPECT_NEAR(costs[1], 0.0, 1e-5);
  EXPECT_NEAR(costs[2], 0.15, 1e-5);
  EXPECT_NEAR(cost.mean({2, 2, 0}), 0.4 / 3, 1e-5);
}

TEST(ScanCost, PolarDistanceIsTheRootMeanSquareOverTheHits) {
  const PolygonMap map = squareMap(4.0);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const RangeScan scan({{kPi / 2, 1.75, BeamKind::hit},
                        {0.0, 2.5, BeamKind::hit},
                        {kPi, 10.0, BeamKind::no_return},
                        {-kPi / 2, 2.0, BeamKind::hit}});
  const ScanCost cost(predictor, scan, {});
  EXPECT_NEAR(cost.polarDistance({2, 2, 0}), std::sqrt((0.0625 + 0.25) / 3), 1e-5);
}

TEST(ScanCost, PolarDistanceStaysFiniteWhereNoWallIsMet) {
  const PolygonMap map = withOpenEdges(squareMap(4.0), 1.0, 1);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const auto distance = [&](double range) {
    return ScanCost(predictor, RangeScan({{0.0, range, BeamKind::hit}}), {})
        .polarDistance({2, 2, 0});
  };
  EXPECT_NEAR(distance(2.0), 125.5, 1e-5);
  EXPECT_EQ(distance(300.0), 0.0);  // both count as 127.5 m
}

TEST(ScanCost, OfNoBeamsIsNothing) {
  const PolygonMap map = squareMap(4.0);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const ScanCost cost(predictor, RangeScan({}), {});
  EXPECT_EQ(cost.beamCount(), 0U);
  EXPECT_EQ(cost.mean({2, 2, 0}), 0.0);
  EXPECT_EQ(cost.polarDistance({2, 2, 0}), 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc::test
