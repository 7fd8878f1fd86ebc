#include "tests/support/brute_force_cost.h"
#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

/// The law of the certificate: no pose whose search cost is at most the certified one lies outside
/// of the regions returned, whatever is tried to find one.
namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

bool regionHolds(const PoseRegion& region, const TPose2D& pose) {
  const double window = std::remainder(region.last_heading - region.first_heading, 2 * kPi);
  const double turn = pose.phi - region.first_heading;
  if (turn - 2 * kPi * std::floor(turn / (2 * kPi)) > window + 1e-6 &&
      std::abs(std::remainder(turn, 2 * kPi)) > 1e-6) {
    return false;
  }
  for (std::size_t i = 0; i < region.polygon.size(); ++i) {
    const TPoint2D &a = region.polygon[i], &b = region.polygon[(i + 1) % region.polygon.size()];
    const double side = (b.x - a.x) * (pose.y - a.y) - (b.y - a.y) * (pose.x - a.x);
    if (side < -1e-6 * std::hypot(b.x - a.x, b.y - a.y)) return false;
  }
  return true;
}

/// What was tried against one result.
struct Attempt {
  std::size_t poses = 0;
  std::size_t below = 0;  ///< poses of at most the certified cost
  std::size_t outside = 0;
  double worst = 0.0;  ///< how far below the certified cost [m]
};

class CertificateAdversary {
 public:
  CertificateAdversary(const PolygonMap& map, const LocalizationResult& result,
                       const BruteForceCost& cost, std::mt19937& random)
      : map_(map), triangulation_(map), result_(result), cost_(cost), random_(random) {}

  /// The cost of a pose, which is held against the certificate; infinite outside free space.
  double attempt(const TPose2D& pose) {
    if (!triangulation_.isFree({pose.x, pose.y})) return std::numeric_limits<double>::infinity();
    const double cost = cost_(pose);
    ++tally.poses;
    // Ranges are bounded in single precision.
    const double gap = result_.certificate->cost - 1e-4 - cost;
    if (gap < 0) return cost;
    ++tally.below;
    if (std::none_of(result_.regions.begin(), result_.regions.end(),
                     [&](const PoseRegion& region) { return regionHolds(region, pose); })) {
      ++tally.outside;
      tally.worst = std::max(tally.worst, gap);
    }
    return cost;
  }

  /// Poses all over free space, and the best of them moved to lower costs step by step.
  void search(std::size_t samples, std::size_t climbers, std::size_t steps) {
    std::uniform_real_distribution<double> angle(-kPi, kPi);
    std::vector<std::pair<double, TPose2D>> found;
    for (const TPoint2D& p : randomFreePoints(map_, samples, random_)) {
      const TPose2D pose{p.x, p.y, angle(random_)};
      found.emplace_back(attempt(pose), pose);
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    if (found.size() > climbers) found.resize(climbers);
    for (const auto& [cost, pose] : found) climb(pose, steps);
  }

  void climb(TPose2D pose, std::size_t steps) {
    std::normal_distribution<double> normal;
    double cost = attempt(pose), size = 0.2;
    for (std::size_t i = 0; i < steps; ++i) {
      const TPose2D next{pose.x + size * normal(random_), pose.y + size * normal(random_),
                         pose.phi + 0.3 * size * normal(random_)};
      const double next_cost = attempt(next);
      size = next_cost < cost ? std::min(1.5 * size, 0.5) : std::max(0.9 * size, 0.005);
      if (next_cost < cost) {
        pose = next;
        cost = next_cost;
      }
    }
  }

  Attempt tally;

 private:
  const PolygonMap& map_;
  Triangulation triangulation_;
  const LocalizationResult& result_;
  const BruteForceCost& cost_;
  std::mt19937& random_;
};

SearchOptions withRegions(SearchMetric metric = SearchMetric::robust) {
  SearchOptions options;
  options.keep_regions = true;
  options.metric = metric;
  return options;
}

GlobalLocalizerParams limitedTo(std::size_t max_nodes) {
  GlobalLocalizerParams params;
  params.certified.max_nodes = max_nodes;
  return params;
}

/// Clean, cluttered and partial views, aligned with the bins and not.
std::vector<ScanOptions> kindsOfScans(std::uint32_t seed) {
  std::vector<ScanOptions> kinds(5);
  for (ScanOptions& kind : kinds) {
    kind.sigma = 0.02;
    kind.seed = seed;
  }
  kinds[1].short_share = 0.3;
  kinds[2].field_of_view = kPi;
  kinds[2].beams = 180;
  kinds[3].beams = 227;  // meets the bins anywhere
  kinds[3].short_share = 0.1;
  kinds[4].max_range = 4.0;  // no-returns
  kinds[4].sensor = {0.3, 0.1};
  return kinds;
}

TEST(Certificate, NoPoseOutsideTheRegionsCostsLess) {
  std::mt19937 random(6);
  Attempt all;
  std::size_t maps = 0, scans = 0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE("map " + std::to_string(seed));
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const GlobalLocalizer localizer(map);
    ++maps;
    for (const ScanOptions& options : kindsOfScans(seed)) {
      SCOPED_TRACE("scan " + std::to_string(scans));
      const TPoint2D place = randomFreePoints(map, 1, random).front();
      const TPose2D truth{place.x, place.y, std::uniform_real_distribution<>(-kPi, kPi)(random)};
      const RangeScan scan = simulatedScan(map, truth, options);
      const LocalizationResult result = localizer.localize(scan, {}, withRegions());
      if (result.status == LocalizationStatus::too_few_beams) continue;
      ++scans;
      ASSERT_TRUE(result.certificate);
      EXPECT_TRUE(result.certificate->is_complete);
      EXPECT_EQ(result.certificate->regions, result.regions.size());
      const BruteForceCost cost(map, scan);
      CertificateAdversary adversary(map, result, cost, random);
      adversary.search(300, 6, 60);
      adversary.climb(scan.beamFrameFromRobot(truth), 60);
      for (const Hypothesis& hypothesis : result.hypotheses) {
        adversary.climb(scan.beamFrameFromRobot(hypothesis.pose_map_robot), 20);
      }
      EXPECT_EQ(adversary.tally.outside, 0U)
          << "of " << adversary.tally.below << ", by " << adversary.tally.worst << " m";
      all.poses += adversary.tally.poses;
      all.below += adversary.tally.below;
    }
  }
  std::cout << maps << " maps, " << scans << " scans, " << all.poses << " poses, of which "
            << all.below << " cost at most what was certified\n";
  EXPECT_GT(all.below, 1000U);  // else nothing was tested
}

TEST(Certificate, HoldsForThePolarMetric) {
  std::mt19937 random(16);
  Attempt all;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("map " + std::to_string(seed));
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const GlobalLocalizer localizer(map);
    for (const ScanOptions& options : kindsOfScans(seed)) {
      const TPoint2D place = randomFreePoints(map, 1, random).front();
      const TPose2D truth{place.x, place.y, std::uniform_real_distribution<>(-kPi, kPi)(random)};
      const RangeScan scan = simulatedScan(map, truth, options);
      const LocalizationResult result =
          localizer.localize(scan, {}, withRegions(SearchMetric::polar));
      if (result.status == LocalizationStatus::too_few_beams) continue;
      ASSERT_TRUE(result.certificate && result.certificate->is_complete);
      const BruteForceCost cost(map, scan, SearchMetric::polar);
      CertificateAdversary adversary(map, result, cost, random);
      adversary.search(200, 6, 60);
      adversary.climb(scan.beamFrameFromRobot(truth), 60);
      EXPECT_EQ(adversary.tally.outside, 0U)
          << "of " << adversary.tally.below << ", by " << adversary.tally.worst << " m";
      all.below += adversary.tally.below;
    }
  }
  EXPECT_GT(all.below, 300U);
}

TEST(Certificate, CoversThePoseOfTheScanAndLeavesOutMostOfTheMap) {
  const PolygonMap map = floorPlan(largeFloor(), 3);
  const GlobalLocalizer localizer(map);
  std::mt19937 random(7);
  for (const TPoint2D& p : randomFreePoints(map, 8, random)) {
    const TPose2D truth{p.x, p.y, 1.0};
    const RangeScan scan = simulatedScan(map, truth);
    const LocalizationResult result = localizer.localize(scan, {}, withRegions());
    ASSERT_TRUE(result.certificate);
    // A scan without noise costs nothing where it was taken.
    EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
                            [&](const PoseRegion& region) { return regionHolds(region, truth); }));
    ASSERT_FALSE(result.hypotheses.empty());
    const TPose2D& first = result.hypotheses.front().pose_map_robot;
    EXPECT_LT(distanceBetween(first, truth), 1e-3);
    EXPECT_LT(turnBetween(first, truth), 0.01 * kPi / 180);
    double area = 0.0;
    for (const PoseRegion& region : result.regions) area += signedArea(region.polygon);
    EXPECT_LT(area / static_cast<double>(kBandBins), 0.02 * map.area());
  }
}

TEST(Certificate, HoldsUnderAPrior) {
  std::mt19937 random(8);
  const PolygonMap map = floorPlan(randomParams(random), 3);
  const GlobalLocalizer localizer(map);
  for (int i = 0; i < 6; ++i) {
    const TPoint2D place = randomFreePoints(map, 1, random).front();
    const TPose2D truth{place.x, place.y, 0.5 * i};
    const RangeScan scan = simulatedScan(map, truth, kindsOfScans(1)[0]);
    PosePrior prior;
    prior.compass = PosePrior::Compass{truth.phi + 0.1, 0.2};
    prior.near = PosePrior::Disk{truth.x + 1.0, truth.y, 2.0};
    const LocalizationResult free = localizer.localize(scan, {}, withRegions());
    const LocalizationResult bound = localizer.localize(scan, prior, withRegions());
    ASSERT_TRUE(free.certificate && bound.certificate);
    EXPECT_LT(bound.statistics.evaluated, free.statistics.evaluated);
    const BruteForceCost cost(map, scan);
    CertificateAdversary adversary(map, bound, cost, random);
    for (int k = 0; k < 400; ++k) {
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      adversary.attempt({truth.x + 0.02 * unit(random), truth.y + 0.02 * unit(random),
                         truth.phi + 0.005 * unit(random)});
    }
    EXPECT_GT(adversary.tally.below, 10U);
    EXPECT_EQ(adversary.tally.outside, 0U) << adversary.tally.worst;
  }
}

TEST(Certificate, OfAPriorThatAllowsNoCellEnds) {
  // A block of the top level meets the disk, but none of its leaves: there is a pillar.
  const PolygonMap map = mapOf(rectangle(0, 0, 1.9, 1.9), {rectangle(0.5, 0.5, 1.4, 1.4)});
  const GlobalLocalizer localizer(map);
  PosePrior prior;
  prior.near = PosePrior::Disk{0.95, 0.95, 0.1};
  const LocalizationResult result =
      localizer.localize(simulatedScan(map, {0.25, 0.25, 0.3}), prior, withRegions());
  EXPECT_EQ(result.status, LocalizationStatus::no_match);
  ASSERT_TRUE(result.certificate);
  EXPECT_TRUE(result.certificate->is_complete);
  EXPECT_TRUE(result.regions.empty());
}

TEST(Certificate, OfABudgetTooSmallForAnythingThereIsNone) {
  const PolygonMap map = asymmetricRoom();
  const GlobalLocalizer localizer(map, limitedTo(1));
  const TPose2D truth{1.5, 2.1, 0.3};
  const LocalizationResult result =
      localizer.localize(simulatedScan(map, truth), {}, withRegions());
  EXPECT_FALSE(result.certificate);  // nothing is proven
  EXPECT_TRUE(result.regions.empty());
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);  // others may be as good
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_LT(distanceBetween(result.hypotheses.front().pose_map_robot, truth), 0.02);
}

TEST(Certificate, AtAnyBudgetHoldsThePoseOfAScanWithoutNoise) {
  // Its cost is 0, so that whatever is certified must leave room for it.
  const PolygonMap map = floorPlan(largeFloor(), 5);
  const MapIndex::Ptr index = MapIndex::build(map);
  std::mt19937 random(10);
  std::size_t certified = 0;
  for (const TPoint2D& p : randomFreePoints(map, 8, random)) {
    const TPose2D truth{p.x, p.y, 0.7};
    ScanOptions clutter;
    clutter.short_share = 0.0;
    const RangeScan scan = simulatedScan(map, truth, clutter);
    const std::size_t all = GlobalLocalizer(index).localize(scan).statistics.evaluated;
    for (const std::size_t nodes :
         {std::size_t{1}, all / 10, all / 2, all - 1000, all - 200, all - 20, all - 1}) {
      const auto result =
          GlobalLocalizer(index, limitedTo(nodes)).localize(scan, {}, withRegions());
      if (!result.certificate) continue;
      ++certified;
      EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
                              [&](const PoseRegion& region) { return regionHolds(region, truth); }))
          << nodes << " nodes";
    }
  }
  EXPECT_GT(certified, 3U);
}

TEST(Certificate, HoldsForBeamsThatUseUpTheAngularSlack) {
  // Every third beam is as far off the phase as beams that are searched with may be, to the side on
  // which it is not in its bin; the robot's heading is where a bin begins.
  std::mt19937 random(17);
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const PolygonMap map = floorPlan(randomParams(random), seed);
    const BruteForceRays rays(map);
    const GlobalLocalizer localizer(map);
    for (const TPoint2D& p : randomFreePoints(map, 15, random)) {
      const double heading = static_cast<double>(random() % kBandBins) * kBandBinWidth;
      std::vector<Beam> beams;
      for (std::size_t b = 0; b < kBandBins; ++b) {
        const double off = b % 3 == 0 ? -0.99 * kInPhase : 0.0;
        const double bearing = (static_cast<double>(b) + off) * kBandBinWidth;
        const RayHit hit = rays.cast(p, heading + bearing);
        if (std::isfinite(hit.wall) && !(hit.open < hit.wall)) {
          beams.push_back({bearing, hit.wall, BeamKind::hit});
        }
      }
      if (beams.size() < 60) continue;
      const RangeScan scan(beams);
      ASSERT_TRUE(BandQuery(scan).is_in_phase);
      ASSERT_EQ(BandQuery(scan).beams.size(), beams.size());
      const auto result = localizer.localize(scan, {}, withRegions());
      ASSERT_TRUE(result.certificate);
      EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
                              [&](const PoseRegion& region) {
                                return regionHolds(region, {p.x, p.y, heading});
                              }))
          << p.x << " " << p.y << " " << heading;
    }
  }
}

TEST(Certificate, HoldsBeyondTheGreatestRange) {
  // 600 m long: ranges beyond 127 m are told from shorter ones alone.
  const PolygonMap map = mapOf(rectangle(0, 0, 600, 8));
  const GlobalLocalizer localizer(MapIndex::build(map, {0.5, 1}));
  const TPose2D truth{3.1, 4.2, 0.0};
  const RangeScan scan = simulatedScan(map, truth, [] {
    ScanOptions options;
    options.max_range = 1000.0;
    return options;
  }());
  const LocalizationResult result = localizer.localize(scan, {}, withRegions());
  ASSERT_TRUE(result.certificate);
  EXPECT_TRUE(std::any_of(result.regions.begin(), result.regions.end(),
                          [&](const PoseRegion& region) { return regionHolds(region, truth); }));
}

TEST(Certificate, HoldsWithANearHorizon) {
  // Walls behind open edges that are known from some points of a leaf and not from others.
  std::mt19937 random(11);
  Attempt all;
  std::size_t beyond = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("map " + std::to_string(seed));
    const PolygonMap map = floorPlan(randomParams(random), seed);
    if (map.openPerimeter() < 2.0) continue;
    MapIndexParams params;
    params.horizon = seed % 2 == 0 ? 0.5 : 2.0;
    const GlobalLocalizer localizer(MapIndex::build(map, params));
    const BruteForceRays near(map, params.horizon), far(map);
    for (const ScanOptions& options : kindsOfScans(seed)) {
      const TPoint2D place = randomFreePoints(map, 1, random).front();
      const TPose2D truth{place.x, place.y, std::uniform_real_distribution<>(-kPi, kPi)(random)};
      for (int k = 0; k < 90; ++k) {
        beyond += near.cast(place, 0.07 * k).wall > far.cast(place, 0.07 * k).wall ? 1 : 0;
      }
      const RangeScan scan = simulatedScan(map, truth, options);
      const LocalizationResult result = localizer.localize(scan, {}, withRegions());
      if (result.status == LocalizationStatus::too_few_beams) continue;
      ASSERT_TRUE(result.certificate);
      const BruteForceCost cost(map, scan, SearchMetric::robust, params.horizon);
      CertificateAdversary adversary(map, result, cost, random);
      adversary.search(300, 6, 60);
      adversary.climb(scan.beamFrameFromRobot(truth), 60);
      EXPECT_EQ(adversary.tally.outside, 0U)
          << "of " << adversary.tally.below << ", by " << adversary.tally.worst << " m";
      all.below += adversary.tally.below;
    }
  }
  EXPECT_GT(all.below, 300U);
  EXPECT_GE(beyond, 50U);  // beams that the horizon ends
}

TEST(Certificate, SaysHowFarABudgetReached) {
  const PolygonMap map = floorPlan(largeFloor(), 4);
  std::mt19937 random(9);
  const TPoint2D place = randomFreePoints(map, 1, random).front();
  const RangeScan scan = simulatedScan(map, {place.x, place.y, 0.3}, kindsOfScans(1)[1]);
  const MapIndex::Ptr index = MapIndex::build(map);
  const LocalizationResult complete = GlobalLocalizer(index).localize(scan);
  ASSERT_TRUE(complete.certificate && complete.certificate->is_complete);

  const GlobalLocalizer limited(index, limitedTo(complete.statistics.evaluated / 2));
  const LocalizationResult cut = limited.localize(scan, {}, withRegions());
  ASSERT_TRUE(cut.certificate);
  EXPECT_FALSE(cut.certificate->is_complete);
  EXPECT_LT(cut.certificate->cost, complete.certificate->cost);
  EXPECT_LT(cut.statistics.evaluated, complete.statistics.evaluated);
  const BruteForceCost cost(map, scan);
  CertificateAdversary adversary(map, cut, cost, random);
  adversary.search(200, 6, 60);
  EXPECT_EQ(adversary.tally.outside, 0U) << adversary.tally.worst;
}

}  // namespace
}  // namespace mrpt_polyloc::test
