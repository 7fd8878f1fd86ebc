#include "search_fixture.h"
#include <mrpt_polyloc/localization/search/bound_costs.h>
#include <mrpt_polyloc/localization/search/settle_leaves.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

/// What became of each region, told once more from the definitions of SettledRegions, all pairs of
/// regions looked at.
namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// The leaves of a search that has come to an end.
struct Remaining {
  Remaining(const SearchedMap& searched, const RangeScan& range_scan, double margin)
      : built(searched),
        scan(range_scan),
        query(scan, GlobalLocalizerParams{}.search_cost),
        allowed(built.triangulation, prior, scan.sensor()),
        scorer(built.predictor, query, scan.sensor(), allowed, GlobalLocalizerParams{}.search_cost,
               {}),
        leaves(built.tree, query, params) {
    TreeDescent::Workspace workspace;
    TreeDescent descent(built.tree, allBlocks(built.tree), query, prior, scan.sensor(), workspace);
    const auto never = [] { return false; };
    for (double cost = 0.02; !std::isfinite(least); cost *= 2.0) {
      descent.expandUpTo(query.units(cost), never, leaves.leaves());
      leaves.evaluate();
      for (const PoseCandidate& seed : leaves.best(5)) {
        least = std::min(least, scorer.costBelow(seed.pose_map_beams));
      }
    }
    limit = query.units(least + margin);
    descent.expandUpTo(limit, never, leaves.leaves());
    leaves.evaluate();
  }

  SettledLeaves settle(const Budget& budget = Budget()) {
    return settleLeaves(leaves, limit, least, query, scorer, budget, params);
  }

  const SearchedMap& built;
  RangeScan scan;
  PosePrior prior;
  BandQuery query;
  AllowedPoses allowed;
  PoseScorer scorer;
  CertifiedSearchParams params;
  SeedPoses leaves;
  double least = std::numeric_limits<double>::infinity();
  unsigned limit = 0;
};

/// A square of the grid and a window of headings, and the leaf that costs least in it.
struct Place {
  long column, row, window;
  std::size_t leaf, leaves;
};

constexpr long kWindows = 90;

bool isBeside(const Place& a, const Place& b) {
  const long turn = std::abs(a.window - b.window);
  return std::abs(a.column - b.column) <= 1 && std::abs(a.row - b.row) <= 1 &&
         std::min(turn, kWindows - turn) <= 1;
}

struct Expected {
  SettledRegions counts;
  std::vector<std::size_t> bottoms;
};

Expected settleByPairs(Remaining& r) {
  Expected expected;
  std::map<std::tuple<long, long, long>, Place> by_cell;
  const double reach = r.leaves.areFew(r.params.max_candidates) ? 1e9 : r.least + r.params.reach;
  const auto cheaper = [&](std::size_t a, std::size_t b) {
    return std::make_pair(r.leaves.cost(a), a) < std::make_pair(r.leaves.cost(b), b);
  };
  for (std::size_t i = 0; i < r.leaves.leaves().size(); ++i) {
    const TreeDescent::Node& leaf = r.leaves.leaves()[i];
    if (leaf.bound > r.limit) continue;
    unsigned of_bins[2] = {};
    const std::uint32_t bins[] = {leaf.heading, leaf.heading + 1};
    boundCostsOfBins(r.built.tree.bands(0, leaf.index), r.query, bins, 2, of_bins);
    const unsigned least = r.query.units(r.least);
    if (leaf.bound > least) {
      ++expected.counts.bounded;
    } else if (r.leaves.costIfWorthwhile(i, static_cast<float>(reach)) >
               static_cast<float>(reach)) {
      ++expected.counts.distant;
    } else if (std::min(of_bins[0], of_bins[1]) > least) {
      ++expected.counts.bounded;
    } else {
      const TPoint2D p = r.leaves.middle(i);
      const Place place{std::lround(std::floor(p.x / 0.25)), std::lround(std::floor(p.y / 0.25)),
                        static_cast<long>(leaf.heading / 2), i, 1};
      const auto [found, is_new] =
          by_cell.try_emplace({place.column, place.row, place.window}, place);
      if (is_new) continue;
      ++found->second.leaves;
      if (cheaper(i, found->second.leaf)) found->second.leaf = i;
    }
  }
  std::vector<Place> places;
  for (const auto& cell : by_cell) places.push_back(cell.second);
  std::sort(places.begin(), places.end(),
            [&](const Place& a, const Place& b) { return cheaper(a.leaf, b.leaf); });
  std::vector<std::size_t> bottom_of(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    // In the order of cost: the first neighbour is the cheapest.
    std::size_t next = 0;
    while (next < i && !isBeside(places[next], places[i])) ++next;
    std::size_t bottom = next == i ? i : bottom_of[next];
    const long away = std::max(std::abs(places[i].column - places[bottom].column),
                               std::abs(places[i].row - places[bottom].row));
    const float more = r.leaves.cost(places[i].leaf) - r.leaves.cost(places[bottom].leaf);
    if (away >= 4 && static_cast<double>(more) <= 0.03) bottom = i;  // a metre, and level
    bottom_of[i] = bottom;
    if (bottom == i) {
      ++expected.counts.lowered;
      expected.bottoms.push_back(places[i].leaf);
    }
    expected.counts.drained += places[i].leaves - (bottom == i ? 1 : 0);
  }
  return expected;
}

void expectSettledAsByPairs(Remaining& r) {
  const SettledLeaves settled = r.settle();
  const Expected expected = settleByPairs(r);
  EXPECT_EQ(settled.counts.bounded, expected.counts.bounded);
  EXPECT_EQ(settled.counts.distant, expected.counts.distant);
  EXPECT_EQ(settled.counts.lowered, expected.counts.lowered);
  EXPECT_EQ(settled.counts.drained, expected.counts.drained);
  EXPECT_EQ(settled.counts.undecided, 0U);
  // Where descents from the bottoms end.
  const double most = r.query.meters(r.limit);
  const auto isListed = [&](const TPose2D& pose) {
    return std::any_of(settled.optima.begin(), settled.optima.end(), [&](const auto& optimum) {
      return distanceBetween(optimum.pose_map_beams, pose) < 0.05 &&
             turnBetween(optimum.pose_map_beams, pose) < 0.02;
    });
  };
  for (const std::size_t leaf : expected.bottoms) {
    const auto optimum = r.scorer.nearOptimum(r.leaves.pose(leaf), 1e9);
    if (!optimum || optimum->cost > most) continue;
    // What three steps bring to within 0.12 m is lowered to its end.
    if (!r.scorer.nearOptimum(r.leaves.pose(leaf), most + 0.12)) continue;
    EXPECT_TRUE(isListed(optimum->refined.pose_map_beams));
  }
  for (std::size_t i = 0; i < settled.optima.size(); ++i) {
    EXPECT_LE(settled.optima[i].cost, most);
    EXPECT_NEAR(settled.optima[i].cost, r.scorer.costAt(settled.optima[i].pose_map_beams), 1e-9);
    if (i > 0) {
      EXPECT_GE(settled.optima[i].cost, settled.optima[i - 1].cost);
    }
    for (std::size_t k = 0; k < i; ++k) {  // none twice
      const TPose2D &a = settled.optima[i].pose_map_beams, &b = settled.optima[k].pose_map_beams;
      EXPECT_FALSE(distanceBetween(a, b) < 0.049 && turnBetween(a, b) < 0.019);
    }
  }
}

RangeScan clutteredScan(const PolygonMap& map, const TPose2D& truth, double short_share,
                        double max_range, std::uint32_t seed) {
  ScanOptions options;
  options.sigma = 0.02;
  options.short_share = short_share;
  options.max_range = max_range;
  options.seed = seed;
  return simulatedScan(map, truth, options);
}

TEST(SettleLeaves, OfBuildingsAsByAllPairs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  SettledRegions all;
  std::size_t optima = 0;
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    const SearchedMap built(smallBuilding(seed));
    for (const double margin : {0.01, 0.1}) {
      SCOPED_TRACE("map " + std::to_string(seed) + ", margin " + std::to_string(margin));
      const TPoint2D p = randomFreePoints(built.map, 1, random).front();
      // The last heading windows as well as the first ones are met.
      const TPose2D truth{p.x, p.y, seed % 2 == 0 ? 0.01 : angle(random)};
      Remaining r(built, clutteredScan(built.map, truth, 0.3, 20.0, seed), margin);
      r.params.max_candidates = seed % 2 == 0 ? 200 : 1;  // few leaves, or not
      r.params.reach = 0.2;
      expectSettledAsByPairs(r);
      const SettledRegions counts = r.settle().counts;
      all.bounded += counts.bounded;
      all.distant += counts.distant;
      all.lowered += counts.lowered;
      all.drained += counts.drained;
      optima += r.settle().optima.size();
    }
  }
  // Else nothing was tested.
  EXPECT_GT(all.bounded, 100U);
  EXPECT_GT(all.distant, 100U);
  EXPECT_GT(all.lowered, 50U);
  EXPECT_GT(all.drained, 500U);
  EXPECT_GT(optima, 10U);
}

TEST(SettleLeaves, ALevelCorridorIsLoweredOnceAMetre) {
  const SearchedMap built(mapOf(rectangle(0, 0, 24, 2)));
  Remaining r(built, clutteredScan(built.map, {11.3, 0.9, 0.3}, 0.0, 3.5, 1), 0.01);
  expectSettledAsByPairs(r);
  const SettledLeaves settled = r.settle();
  for (double x = 5.0; x < 19.0; x += 0.5) {
    EXPECT_TRUE(std::any_of(settled.optima.begin(), settled.optima.end(), [x](const auto& optimum) {
      return std::abs(optimum.pose_map_beams.x - x) < 1.1;
    })) << x;
  }
  EXPECT_LT(settled.optima.size(), 200U);
}

TEST(SettleLeaves, WhatTimeOrNumbersLeaveIsUndecided) {
  const SearchedMap built(smallBuilding(3));
  const TPoint2D p = built.tree.middle(built.tree.nodes(0).size() / 2);
  Remaining r(built, clutteredScan(built.map, {p.x, p.y, 1.0}, 0.4, 20.0, 5), 0.1);
  const SettledRegions whole = r.settle().counts;
  ASSERT_GT(whole.lowered, 3U);
  for (const std::size_t most : {std::size_t{1}, std::size_t{3}}) {
    r.params.max_lowered = most;
    const SettledRegions cut = r.settle().counts;
    EXPECT_EQ(cut.lowered, most);
    EXPECT_GT(cut.undecided, 0U);
    EXPECT_EQ(cut.lowered + cut.drained + cut.undecided, whole.lowered + whole.drained);
    EXPECT_EQ(cut.bounded, whole.bounded);
  }
  const std::atomic<bool> cancel{true};
  const SettledLeaves none = r.settle(Budget(0.0, &cancel));
  EXPECT_EQ(none.counts.undecided, whole.lowered + whole.drained);
  EXPECT_TRUE(none.optima.empty());
}

}  // namespace
}  // namespace mrpt_polyloc::test
