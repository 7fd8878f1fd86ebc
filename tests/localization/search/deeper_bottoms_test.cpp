#include "search_fixture.h"
#include <mrpt_polyloc/localization/search/PoseScorer.h>
#include <mrpt_polyloc/localization/search/deeper_bottoms.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// The costs of a scan in a map, and what Gauss-Newton makes of a start.
struct Scored {
  Scored(const SearchedMap& built, const RangeScan& range_scan, const PosePrior& pose_prior)
      : scan(range_scan),
        prior(pose_prior),
        query(scan, GlobalLocalizerParams{}.search_cost),
        allowed(built.triangulation, prior, scan.sensor()),
        scorer(built.predictor, query, scan.sensor(), allowed, GlobalLocalizerParams{}.search_cost,
               {}) {}

  PoseCandidate optimumBelow(const TPose2D& start) const {
    const auto found = scorer.optimumBelow(start);
    return {found->refined.pose_map_beams, found->cost};
  }

  RangeScan scan;
  PosePrior prior;
  BandQuery query;
  AllowedPoses allowed;
  PoseScorer scorer;
};

RangeScan scanFrom(const PolygonMap& map, const TPose2D& truth, std::uint32_t seed) {
  ScanOptions options;
  options.sigma = 0.03;
  options.short_share = 0.3;
  options.seed = seed;
  return simulatedScan(map, truth, options);
}

/// The least cost of a fine grid of poses around one: an oracle that no descent can mislead.
double leastAround(const Scored& scored, const TPose2D& pose) {
  double least = 1e9;
  for (int x = -8; x <= 8; ++x) {
    for (int y = -8; y <= 8; ++y) {
      for (int turn = -6; turn <= 6; ++turn) {
        least = std::min(least, scored.scorer.costIfAllowed({pose.x + 0.05 * x, pose.y + 0.05 * y,
                                                             pose.phi + 0.015 * turn}));
      }
    }
  }
  return least;
}

TEST(DeeperBottoms, ComeNearerToTheLeastOfAllPosesAroundThanGaussNewton) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double before = 0.0, after = 0.0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const SearchedMap built(smallBuilding(seed));
    for (const TPoint2D& p : randomFreePoints(built.map, 5, random)) {
      const Scored scored(built, scanFrom(built.map, {p.x, p.y, 0.4}, seed), {});
      // Optima of all kinds: also such as are not the right ones.
      const PoseCandidate optimum = scored.optimumBelow(
          {p.x + 0.3 * normal(random), p.y + 0.3 * normal(random), 0.4 + 0.05 * normal(random)});
      const DeeperBottoms found = deeperBottoms({optimum}, scored.scorer);
      EXPECT_LE(found.least, optimum.cost);
      const double least = leastAround(scored, optimum.pose_map_beams);
      before += std::max(0.0, optimum.cost - least);
      after += std::max(0.0, found.least - least);
      for (const PoseCandidate& end : found.ends) {
        EXPECT_EQ(end.cost, scored.scorer.costAt(end.pose_map_beams));
        EXPECT_LE(end.cost, optimum.cost);
        EXPECT_GE(end.cost, found.least);
      }
    }
  }
  EXPECT_GT(before, 0.01);
  EXPECT_LT(after, 0.3 * before);
}

TEST(DeeperBottoms, AreFoundOfEachOptimumAndTheLeastIsOfAll) {
  const SearchedMap built(smallBuilding(2));
  std::mt19937 random(2);
  const TPoint2D p = randomFreePoints(built.map, 1, random).front();
  const Scored scored(built, scanFrom(built.map, {p.x, p.y, 1.0}, 7), {});
  std::vector<PoseCandidate> optima;
  double least = 1e9;
  std::size_t ends = 0;
  for (const TPoint2D& from : randomFreePoints(built.map, 4, random)) {
    const TPose2D start(from.x, from.y, 1.0);
    if (!scored.allowed.contains(start)) continue;
    optima.push_back(scored.optimumBelow(start));
    const DeeperBottoms alone = deeperBottoms({optima.back()}, scored.scorer);
    least = std::min(least, alone.least);
    ends += alone.ends.size();
  }
  ASSERT_GT(optima.size(), 1U);
  const DeeperBottoms all = deeperBottoms(optima, scored.scorer);
  EXPECT_EQ(all.least, least);
  EXPECT_EQ(all.ends.size(), ends);
}

TEST(DeeperBottoms, KeepToThePrior) {
  const SearchedMap built(smallBuilding(1));
  std::mt19937 random(3);
  for (const TPoint2D& p : randomFreePoints(built.map, 10, random)) {
    PosePrior prior;  // beside the truth, so that costs fall beyond its rim
    prior.near = PosePrior::Disk{p.x + 0.2, p.y, 0.1};
    const Scored scored(built, scanFrom(built.map, {p.x, p.y, 2.0}, 3), prior);
    const TPose2D start(p.x + 0.2, p.y, 2.0);
    if (!scored.allowed.contains(start)) continue;
    const PoseCandidate optimum = scored.optimumBelow(start);
    for (const PoseCandidate& end : deeperBottoms({optimum}, scored.scorer).ends) {
      EXPECT_TRUE(scored.allowed.contains(end.pose_map_beams));
      EXPECT_LT(std::hypot(end.pose_map_beams.x - p.x - 0.2, end.pose_map_beams.y - p.y), 0.101);
    }
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
