#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/scan/PoseDescent.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <gtest/gtest.h>

#include <random>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

TEST(PoseDescent, EndsWhereItMayAndNoDearerThanItBegan) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int held = 0, moved = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    FloorPlanParams plan;
    plan.rooms_per_side = 2;
    plan.furniture_per_room = 2;
    const PolygonMap map = floorPlan(plan, seed);
    const Triangulation triangulation(map);
    const RangePredictor predictor(triangulation, RangePredictor::kSquareSize, 1);
    for (const TPoint2D& p : randomFreePoints(map, 20, random)) {
      ScanOptions options;
      options.short_share = 0.3;
      options.sigma = 0.03;
      const RangeScan scan = simulatedScan(map, {p.x, p.y, unit(random)}, options);
      PosePrior prior;
      if (held % 2 == 0) prior.near = PosePrior::Disk{p.x + 0.2, p.y, 0.25};
      const AllowedPoses allowed(triangulation, prior, scan.sensor());
      const ScanCost cost(predictor, scan, {});
      const PoseRefiner refiner(predictor, scan);
      const PoseDescent descent(refiner, allowed,
                                [&](const TPose2D& pose) { return cost.mean(pose); });
      const TPose2D start{p.x + 0.3 * unit(random), p.y + 0.3 * unit(random), unit(random)};
      const auto found = descent.descend(start);
      const TPose2D begin = allowed.nearest(start);
      if (!found) {
        EXPECT_FALSE(allowed.contains(begin));
        continue;
      }
      EXPECT_TRUE(allowed.contains(found->refined.pose_map_beams));
      EXPECT_EQ(found->cost, cost.mean(found->refined.pose_map_beams));
      if (allowed.contains(begin)) {
        EXPECT_LE(found->cost, cost.mean(begin));
        distanceBetween(found->refined.pose_map_beams, begin) < 1e-9 ? ++held : ++moved;
      }
    }
  }
  EXPECT_GT(held, 0);
  EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace mrpt_polyloc::test
