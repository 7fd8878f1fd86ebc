#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/inspection/scan_comparison.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

TEST(ScanComparison, PredictsWhatRaysFindAndCostsWhatTheCostSays) {
  const PolygonMap map = asymmetricRoom();
  const MapIndex::Ptr index = MapIndex::build(map);
  ScanOptions options;
  options.beams = 90;
  options.sensor = {0.2, -0.1};
  options.short_share = 0.2;
  const TPose2D taken(1.2, 1.0, 0.4), held(1.5, 1.1, 0.7);
  const RangeScan scan = simulatedScan(map, taken, options);
  const ScanComparison comparison = compareWithMap(*index, scan, held);
  const BruteForceRays rays(map);
  const TPose2D origin = scan.beamFrameFromRobot(held);
  const RobustCost cost;
  ASSERT_EQ(comparison.wall.size(), 90U);
  double sum = 0.0;
  for (std::size_t i = 0; i < 90; ++i) {
    const Beam& beam = scan.beams()[i];
    const double wall = rays.cast({origin.x, origin.y}, origin.phi + beam.bearing).wall;
    EXPECT_NEAR(comparison.wall[i], wall, 1e-3);
    EXPECT_TRUE(std::isinf(comparison.open[i]));
    EXPECT_NEAR(comparison.cost[i],
                cost(beam, static_cast<float>(wall), std::numeric_limits<float>::infinity()), 1e-3);
    sum += static_cast<double>(comparison.cost[i]);
  }
  EXPECT_NEAR(comparison.mean_cost, sum / 90, 1e-6);
}

TEST(ScanComparison, PolarDistanceFindsTheRotationBack) {
  const PolygonMap map = asymmetricRoom();
  const MapIndex::Ptr index = MapIndex::build(map);
  const TPose2D taken(4.2, 1.0, 0.4);
  const RangeScan scan = simulatedScan(map, taken);
  const auto right = compareWithMap(*index, scan, taken).polar;
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->rotation, 0.0, 0.02);
  EXPECT_LE(right->best_distance, right->distance);
  for (const double turn : {-2.5, -0.5, 0.5, 1.0, 3.0}) {
    const auto turned = compareWithMap(*index, scan, {taken.x, taken.y, taken.phi + turn}).polar;
    ASSERT_TRUE(turned);
    EXPECT_NEAR(std::remainder(turned->rotation + turn, 2 * kPi), 0.0, 0.02);
    EXPECT_GT(turned->distance, 2 * turned->best_distance);
  }
}

TEST(ScanComparison, SaysNothingOfScansThatSayNothing) {
  const MapIndex::Ptr index = MapIndex::deferred(asymmetricRoom());
  const ScanComparison none = compareWithMap(*index, RangeScan({}), {1, 1, 0});
  EXPECT_TRUE(none.wall.empty());
  EXPECT_EQ(none.mean_cost, 0.0);
  EXPECT_FALSE(none.polar);
  const RangeScan invalid({{0.1, 0.0, BeamKind::invalid}, {0.2, 3.0, BeamKind::no_return}});
  const ScanComparison some = compareWithMap(*index, invalid, {1, 1, 0});
  EXPECT_EQ(some.cost[0], 0.0F);
  EXPECT_TRUE(std::isinf(some.wall[0]));
  EXPECT_TRUE(std::isfinite(some.wall[1]));
  EXPECT_FALSE(some.polar);
  EXPECT_THROW(compareWithMap(*index, invalid, {std::nan(""), 1, 0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
