#include "search_fixture.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/search/TreeDescent.h>
#include <mrpt_polyloc/localization/search/bound_costs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using Node = TreeDescent::Node;
using Places = std::set<std::pair<std::size_t, std::uint32_t>>;

constexpr unsigned kAll = std::numeric_limits<unsigned>::max();
constexpr std::size_t kHeadings = kBandBins / SearchTree::kWindow[0];

bool never() {
  return false;
}

Places placesOf(const std::vector<Node>& leaves) {
  Places places;
  for (const Node& leaf : leaves) places.emplace(leaf.index, leaf.heading);
  return places;
}

constexpr double kHeading = 0.7;  // of the scans [rad]

RangeScan clutteredScan(const PolygonMap& map, const TPoint2D& p, std::mt19937& random) {
  ScanOptions options;
  options.sigma = 0.02;
  options.short_share = 0.2;
  options.seed = static_cast<std::uint32_t>(random());
  return simulatedScan(map, {p.x, p.y, kHeading}, options);
}
RangeScan clutteredScan(const PolygonMap& map, std::mt19937& random) {
  return clutteredScan(map, randomFreePoints(map, 1, random).front(), random);
}

TEST(TreeDescent, LeavesOutNoPoseThatCostsLess) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t cheap = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const SearchedMap built(smallBuilding(seed));
    const TPoint2D truth = randomFreePoints(built.map, 1, random).front();
    const RangeScan scan = clutteredScan(built.map, truth, random);
    const BandQuery query(scan, GlobalLocalizerParams{}.search_cost);
    const std::size_t count = built.tree.nodes(0).size(), home = leafAt(built.tree, truth);
    const BruteForceCost cost(built.map, scan);
    TreeDescent::Workspace workspace;
    const PosePrior prior;
    TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, {0, 0}, workspace);
    std::vector<Node> leaves;
    for (const double metres : {0.25, 0.4, 0.6}) {
      const unsigned limit = query.units(metres);
      EXPECT_TRUE(descent.expandUpTo(limit, never, leaves));
      const Places places = placesOf(leaves);
      EXPECT_EQ(places.size(), leaves.size());  // each once
      for (std::size_t i = 0; i < leaves.size(); i += 1 + leaves.size() / 100) {
        unsigned bound = 0;
        boundCosts(built.tree.bands(0, leaves[i].index), query, &leaves[i].heading, 1, &bound);
        EXPECT_EQ(leaves[i].bound, bound);
        EXPECT_LE(bound, limit);
      }
      for (int i = 0; i < 300; ++i) {
        // Half of them around the truth, where the cheap ones are.
        const bool near = i % 2 == 0;
        const std::size_t leaf =
            near ? (home + count + random() % 9 - 4) % count : random() % count;
        const double bin = (kHeading + query.phase) / kBandBinWidth + 8.0 * (unit(random) - 0.5);
        const double share = near ? bin / kBandBins : unit(random);
        const HeldPose held = poseIn(built.tree, query, leaf, share - std::floor(share), random);
        if (cost(held.pose_map_beams) > metres - 1e-3) continue;
        ++cheap;
        EXPECT_EQ(places.count({held.leaf, held.heading}), 1U) << metres;
      }
    }
    EXPECT_TRUE(descent.expandUpTo(kAll, never, leaves));
    EXPECT_TRUE(descent.isDone());
    EXPECT_EQ(placesOf(leaves).size(), built.tree.nodes(0).size() * kHeadings);
    EXPECT_GE(descent.evaluated(), leaves.size());
  }
  EXPECT_GT(cheap, 100U);  // else nothing was tested
}

TEST(TreeDescent, TakesWhatThePriorAllowsAndLittleElse) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const SearchedMap built(smallBuilding(1));
  const RangeScan scan = clutteredScan(built.map, random);
  const BandQuery query(scan);
  const TPoint2D sensor(0.3, -0.2);
  std::size_t allowed = 0;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const TPoint2D center = randomFreePoints(built.map, 1, random).front();
    PosePrior prior;
    prior.near = PosePrior::Disk{center.x, center.y, 0.3 + unit(random)};
    prior.compass = PosePrior::Compass{6.0 * unit(random), 0.4 * unit(random)};
    TreeDescent::Workspace workspace;
    TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, sensor, workspace);
    std::vector<Node> leaves;
    EXPECT_TRUE(descent.expandUpTo(kAll, never, leaves));
    const Places places = placesOf(leaves);
    for (int i = 0; i < 10'000; ++i) {
      const HeldPose held =
          poseIn(built.tree, query, random() % built.tree.nodes(0).size(), unit(random), random);
      const TPose2D& beams = held.pose_map_beams;
      // The robot is where its sensor, turned by the heading, leads back to.
      const double c = std::cos(beams.phi), s = std::sin(beams.phi);
      const TPoint2D robot(beams.x - c * sensor.x + s * sensor.y,
                           beams.y - s * sensor.x - c * sensor.y);
      if ((robot - center).norm() > prior.near->radius ||
          angleBetween(beams.phi, prior.compass->heading) > prior.compass->tolerance) {
        continue;
      }
      ++allowed;
      EXPECT_EQ(places.count({held.leaf, held.heading}), 1U);
    }
    const double window = static_cast<double>(SearchTree::kWindow[0]) * kBandBinWidth;
    for (const Node& leaf : leaves) {
      const double middle = query.heading(leaf.heading) + 0.5 * window;
      EXPECT_LE(angleBetween(middle, prior.compass->heading),
                prior.compass->tolerance + 0.5 * window + 1e-6);
      EXPECT_LE((built.tree.middle(leaf.index) - center).norm(),
                prior.near->radius + sensor.norm() + SearchedMap::kLeafSize);
    }
  }
  EXPECT_GT(allowed, 100U);
}

TEST(TreeDescent, StopsWhenToldTo) {
  std::mt19937 random(3);
  const SearchedMap built(smallBuilding(2));
  const BandQuery query(clutteredScan(built.map, random));
  const PosePrior prior;
  TreeDescent::Workspace workspace;
  TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, {0, 0}, workspace);
  std::vector<Node> leaves;
  int asked = 0;
  EXPECT_FALSE(descent.expandUpTo(
      kAll, [&] { return ++asked > 50; }, leaves));
  EXPECT_LT(leaves.size(), built.tree.nodes(0).size() * kHeadings);
}

TEST(TreeDescent, AGreedyDescentComesToTheLeastBoundsIfItIsWideEnough) {
  std::mt19937 random(4);
  const SearchedMap built(smallBuilding(3));
  const BandQuery query(clutteredScan(built.map, random));
  const PosePrior prior;
  const auto descended = [&](std::size_t width) {
    TreeDescent::Workspace workspace;
    TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, {0, 0}, workspace);
    std::vector<Node> leaves;
    descent.greedyDescent(width, leaves);
    return leaves;
  };
  const std::vector<Node> all = descended(1'000'000);
  EXPECT_EQ(placesOf(all).size(), built.tree.nodes(0).size() * kHeadings);
  const auto least = [](const std::vector<Node>& nodes) {
    return std::min_element(nodes.begin(), nodes.end(),
                            [](const Node& a, const Node& b) { return a.bound < b.bound; })
        ->bound;
  };
  const std::vector<Node> few = descended(30);
  ASSERT_FALSE(few.empty());
  EXPECT_LT(few.size(), all.size() / 10);
  EXPECT_LE(query.meters(least(few)), query.meters(least(all)) + 0.1);
}

}  // namespace
}  // namespace mrpt_polyloc::test
