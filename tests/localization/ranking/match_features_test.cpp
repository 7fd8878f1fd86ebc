#include "tests/support/BruteForceRays.h"
#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/ranking/match_features.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

TEST(MatchFeatures, AreSharesOverRaysCastOneByOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-kPi, kPi), off(-0.3, 0.3);
  double hidden = 0.0, unexplained = 0.0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const BruteForceRays rays(map);
    const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
    for (const TPoint2D& p : randomFreePoints(map, 5, random)) {
      ScanOptions options;
      options.short_share = 0.2;
      options.max_range = 6.0;
      options.seed = static_cast<std::uint32_t>(random());
      const RangeScan scan = simulatedScan(map, {p.x, p.y, angle(random)}, options);
      const ScanCost cost(predictor, scan, {});
      const TPose2D pose{p.x + off(random), p.y + off(random), angle(random)};
      double longest = 0.0, hits = 0.0, explained = 0.0, seen = 0.0, view = 0.0, doubt = 0.0;
      for (const Beam& beam : scan.beams()) longest = std::max(longest, beam.range);
      for (const Beam& beam : scan.beams()) {
        if (beam.kind == BeamKind::invalid) continue;
        const RayHit hit = rays.cast({pose.x, pose.y}, pose.phi + beam.bearing);
        const double nearest = std::min(hit.wall, hit.open), reach = std::min(nearest, longest);
        view += reach;
        seen += std::min(beam.range, reach);
        if (beam.kind != BeamKind::hit) continue;
        // A hit before the open edge is held against it, one behind it against the wall there.
        const double miss = std::abs(beam.range - (beam.range < hit.open ? nearest : hit.wall));
        hits += 1.0;
        explained += miss < 0.2;
        doubt += std::abs(miss - 0.2) < 1e-3 || std::abs(beam.range - hit.open) < 1e-3;
      }
      if (hits == 0.0 || view == 0.0) continue;
      ScoredPose first{{pose, {}, 100}, 0.1};
      first.refined.information.setIdentity();
      const MatchFeatures found = matchFeatures({first}, first, cost, BeamSectors(cost.beams()));
      // Single precision, and beams that graze a corner.
      EXPECT_NEAR(found.explained, explained / hits, (doubt + 2.0) / hits);
      EXPECT_NEAR(found.seen, seen / view, 0.01);
      hidden = std::max(hidden, 1.0 - found.seen);
      unexplained = std::max(unexplained, 1.0 - found.explained);
    }
  }
  EXPECT_GT(hidden, 0.2);  // else nothing was tested
  EXPECT_GT(unexplained, 0.2);
}

TEST(MatchFeatures, OfAHalfHiddenScanByHand) {
  // In the middle of a square of 4 m: four beams along the axes, ranges 2, 1, 2.15 and a no-return.
  const PolygonMap map = squareMap(4.0);
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const RangeScan scan({{0.0, 2.0, BeamKind::hit},
                        {kPi / 2, 1.0, BeamKind::hit},
                        {kPi, 2.15, BeamKind::hit},
                        {-kPi / 2, 5.0, BeamKind::no_return}});
  const ScanCost cost(predictor, scan, {});
  const BeamSectors sectors(cost.beams());
  ScoredPose first{{{2, 2, 0}, {}, 3}, 0.08}, second{{{2, 2, 1}, {}, 3}, 0.13};
  first.refined.information.setZero();
  second.refined.information.setZero();
  const MatchFeatures features = matchFeatures({first, second}, first, cost, sectors);
  EXPECT_NEAR(features.explained, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(features.lead, std::log(0.15 / 0.10), 1e-9);
  EXPECT_NEAR(features.seen, (2 + 1 + 2 + 2) / 8.0, 1e-6);
  EXPECT_NEAR(features.heading, std::log(0.1745), 1e-9);  // nothing known but the locality
  // Without a second, one of 0.2 m stands for it: alone is no proof.
  EXPECT_NEAR(matchFeatures({first}, first, cost, sectors).lead, std::log(0.22 / 0.10), 1e-9);
  first.cost = 0.3;
  EXPECT_EQ(matchFeatures({first}, first, cost, sectors).lead, 0.0);
}

}  // namespace
}  // namespace mrpt_polyloc::test
