#include "search_fixture.h"
#include <mrpt_polyloc/localization/search/CertifiedSearch.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// A search of a map for a scan, and all that it needs.
struct Search {
  Search(const SearchedMap& searched, const RangeScan& range_scan)
      : built(searched),
        scan(range_scan),
        query(scan, GlobalLocalizerParams{}.search_cost),
        allowed(built.triangulation, prior, scan.sensor()),
        scorer(built.predictor, query, scan.sensor(), allowed, GlobalLocalizerParams{}.search_cost,
               {}) {}

  CertifiedSearchResult operator()(const CertifiedSearchParams& params = {},
                                   const Budget& budget = Budget()) const {
    return searchTree(built.tree, query, prior, scan.sensor(), scorer, budget, params);
  }

  const SearchedMap& built;
  RangeScan scan;
  PosePrior prior;
  BandQuery query;
  AllowedPoses allowed;
  PoseScorer scorer;
};

RangeScan noisyScan(const PolygonMap& map, const TPose2D& truth, std::uint32_t seed) {
  ScanOptions options;
  options.sigma = 0.02;
  options.short_share = 0.1;
  options.seed = seed;
  return simulatedScan(map, truth, options);
}

/// Two arcs of beams go on through walls, as through glass, and others end at things that are not
/// in the map; the rest is exact.
RangeScan scanOfAChangedWorld(const PolygonMap& map, const TPose2D& truth, std::uint32_t seed) {
  ScanOptions options;
  options.sigma = 0.02;
  options.field_of_view = kPi;
  options.beams = 181;
  options.seed = seed;
  std::vector<Beam> beams = simulatedScan(map, truth, options).beams();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int arc = 0; arc < 4; ++arc) {
    const std::size_t first = random() % 160, count = 15 + random() % 10;
    const bool is_glass = arc % 2 == 0;
    const double off = 1.5 + 2.0 * unit(random), share = 0.3 + 0.4 * unit(random);
    for (std::size_t i = first; i < std::min(first + count, beams.size()); ++i) {
      beams[i].range = is_glass ? beams[i].range + off : beams[i].range * share;
    }
  }
  return RangeScan(beams);
}

TPose2D somewhere(const PolygonMap& map, std::mt19937& random) {
  const TPoint2D p = randomFreePoints(map, 1, random).front();
  return {p.x, p.y, std::uniform_real_distribution<>(-kPi, kPi)(random)};
}

TEST(CertifiedSearch, OffersPlacesThatExplainMostBeamsHoweverWrongTheOthersAre) {
  FloorPlanParams plan;
  plan.rooms_per_side = 8;
  plan.corridors = 2;
  plan.furniture_per_room = 2;
  const SearchedMap built(floorPlan(plan, 5));
  CertifiedSearchParams by_cost_alone;
  by_cost_alone.max_explained = 0;
  int with = 0, without = 0;
  for (std::uint32_t seed = 12; seed < 32; ++seed) {
    std::mt19937 random(seed);
    const TPose2D truth = somewhere(built.map, random);
    const Search search(
        built, scanOfAChangedWorld(built.map, truth, static_cast<std::uint32_t>(random())));
    const auto offers_truth = [&](const CertifiedSearchParams& params) {
      const CertifiedSearchResult found = search(params);
      return std::any_of(found.candidates.begin(), found.candidates.end(),
                         [&](const PoseCandidate& candidate) {
                           return distanceBetween(candidate.pose_map_beams, truth) < 0.35 &&
                                  turnBetween(candidate.pose_map_beams, truth) < 0.1;
                         });
    };
    with += offers_truth({}) ? 1 : 0;
    without += offers_truth(by_cost_alone) ? 1 : 0;
  }
  EXPECT_GE(with, 15);
  EXPECT_LE(without, with - 3);
}

TEST(CertifiedSearch, RegionsHoldEveryPoseUpToTheCertifiedCost) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t below = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const SearchedMap built(smallBuilding(seed));
    const TPose2D truth = somewhere(built.map, random);
    const Search search(built, noisyScan(built.map, truth, seed));
    CertifiedSearchParams params;
    params.margin = 0.1;  // more is proven than usual, so that more can be wrong
    const CertifiedSearchResult found = search(params);
    ASSERT_TRUE(found.certified_cost && found.is_complete);
    std::set<std::pair<std::uint32_t, std::uint32_t>> regions;
    for (const RemainingLeaf& r : found.regions) regions.emplace(r.leaf, r.heading);
    EXPECT_EQ(regions.size(), found.regions.size());
    const BruteForceCost cost(built.map, search.scan);
    const std::size_t home = leafAt(built.tree, {truth.x, truth.y});
    for (int i = 0; i < 3000; ++i) {
      // Half of them around the truth, where the cheap ones are.
      const bool near = i % 2 == 0;
      const std::size_t leaf =
          near ? (home + built.tree.nodes(0).size() + random() % 9 - 4) % built.tree.nodes(0).size()
               : random() % built.tree.nodes(0).size();
      const double bin = (truth.phi + search.query.phase) / kBandBinWidth;
      const double share = near ? (bin + 4.0 * (unit(random) - 0.5)) / kBandBins : unit(random);
      const HeldPose held =
          poseIn(built.tree, search.query, leaf, share - std::floor(share), random);
      EXPECT_GE(cost(held.pose_map_beams), found.at_least - 1e-5);
      if (cost(held.pose_map_beams) > *found.certified_cost - 1e-3) continue;
      ++below;
      EXPECT_EQ(regions.count({static_cast<std::uint32_t>(held.leaf), held.heading}), 1U);
    }
  }
  EXPECT_GT(below, 50U);
}

/// A hall of racks, whose aisles are so narrow that the right leaf's middle may cost far more than
/// a twin's: the best is found only when the regions are settled.
PolygonMap rackHall() {
  std::vector<std::vector<TPoint2D>> racks;
  for (int row = 0; row < 5; ++row) {
    for (int rack = 0; rack < 4; ++rack) {
      const double x = 2.0 + 5.5 * rack + 0.7 * (row % 2), y = 1.8 + 2.6 * row;
      racks.push_back(rectangle(x, y, x + 3.5 + 0.2 * rack, y + 1.0));
    }
  }
  return mapOf(rectangle(0, 0, 27.0, 15.0), racks);
}

TEST(CertifiedSearch, NothingThatItOffersCostsLessThanItsLeast) {
  std::mt19937 random(5);
  const SearchedMap built(rackHall());
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    ScanOptions options;
    options.sigma = 0.03;
    options.seed = seed;
    const TPose2D truth = somewhere(built.map, random);
    const Search search(built, simulatedScan(built.map, truth, options));
    const CertifiedSearchResult found = search();
    ASSERT_TRUE(found.is_complete);
    for (const PoseCandidate& candidate : found.candidates) {
      EXPECT_GE(search.scorer.costAt(candidate.pose_map_beams), found.least_cost - 1e-6);
    }
  }
}

TEST(CertifiedSearch, ProvesTheMarginAboveTheLeastCostAndOffersTheBestFirst) {
  std::mt19937 random(2);
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const SearchedMap built(smallBuilding(seed));
    const TPose2D truth = somewhere(built.map, random);
    const Search search(built, noisyScan(built.map, truth, seed));
    const CertifiedSearchParams params;
    const CertifiedSearchResult found = search();
    ASSERT_FALSE(found.candidates.empty());
    EXPECT_LE(found.candidates.size(), params.max_candidates);
    double least = 1e9;
    for (std::size_t i = 0; i < found.candidates.size(); ++i) {
      const PoseCandidate& candidate = found.candidates[i];
      if (i > 0) {
        EXPECT_GE(candidate.cost, found.candidates[i - 1].cost);
      }
      EXPECT_TRUE(
          built.triangulation.isFree({candidate.pose_map_beams.x, candidate.pose_map_beams.y}));
      if (i < 5) least = std::min(least, search.scorer.costBelow(candidate.pose_map_beams));
    }
    ASSERT_TRUE(found.certified_cost);
    EXPECT_GE(*found.certified_cost, least * (1.0 + params.margin_share) + params.margin - 1e-3);
    EXPECT_LE(found.least_cost, least + 1e-3);
    EXPECT_LT(found.at_least, found.least_cost);
    EXPECT_GT(found.at_least, 0.0);  // a tenth of the beams end early
    // From one of them refinement comes to the truth, or to what explains the scan better.
    const double at_truth = search.scorer.costBelow(truth);
    EXPECT_LE(least, at_truth + 1e-3);
  }
}

TEST(CertifiedSearch, WhatABudgetEndsIsNotCalledComplete) {
  std::mt19937 random(3);
  const SearchedMap built(smallBuilding(5));
  const TPose2D truth = somewhere(built.map, random);
  const Search search(built, noisyScan(built.map, truth, 1));
  const CertifiedSearchResult whole = search();
  CertifiedSearchParams few;
  few.max_nodes = whole.evaluated / 20;
  const CertifiedSearchResult part = search(few);
  EXPECT_FALSE(part.is_complete);
  EXPECT_LT(part.evaluated, whole.evaluated);
  EXPECT_LT(part.certified_cost.value_or(0.0), *whole.certified_cost);
  const std::atomic<bool> cancel{true};
  const CertifiedSearchResult none = search({}, Budget(0.0, &cancel));
  EXPECT_FALSE(none.is_complete);
  EXPECT_FALSE(none.certified_cost);
  EXPECT_FALSE(none.candidates.empty());  // a guess, if nothing is proven
}

TEST(CertifiedSearch, ProvesNothingWithoutBeams) {
  const SearchedMap built(smallBuilding(6));
  const CertifiedSearchResult found = Search(built, RangeScan({}))();
  EXPECT_FALSE(found.certified_cost);
}

}  // namespace
}  // namespace mrpt_polyloc::test
