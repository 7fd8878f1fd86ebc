#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/search/QuantizedRange.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace mrpt_polyloc::test {
namespace {

struct TreeOfMap {
  static constexpr double kSize = 0.25;
  explicit TreeOfMap(PolygonMap polygon_map, int threads = 1)
      : map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, 4 * kSize, threads),
        tree(triangulation, predictor, {kSize, threads}),
        rays(map) {}

  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SearchTree tree;
  BruteForceRays rays;
};

/// The leaves (indices of level 0) below a node: one run.
std::pair<std::size_t, std::size_t> cellsOf(const SearchTree& tree, std::size_t level,
                                            std::size_t node) {
  std::size_t first = node, last = node + 1;
  for (; level > 0; --level) {
    const SearchTree::Node& end = tree.nodes(level)[last - 1];
    first = tree.nodes(level)[first].first_child;
    last = end.first_child + end.child_count;
  }
  return {first, last};
}

TEST(SearchTree, EveryNodeHoldsWhatIsSeenFromItsCellsOverItsWindow) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t gaps = 0;
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TreeOfMap built(floorPlan(randomParams(random), seed));
    const SearchTree& tree = built.tree;
    for (std::size_t level = 0; level < SearchTree::kLevels; ++level) {
      for (int i = 0; i < 400; ++i) {
        const std::size_t node = random() % tree.nodes(level).size();
        const auto [first, last] = cellsOf(tree, level, node);
        const std::size_t leaf = first + random() % (last - first);
        TPoint2D p = tree.middle(leaf);
        p += (tree.polygon(leaf)[random() % tree.polygonSize(leaf)] - p) * (0.999 * unit(random));
        const std::size_t bin = random() % kBandBins;
        const double offset = unit(random) * static_cast<double>(SearchTree::kWindow[level]);
        const RayHit hit = built.rays.cast(p, (static_cast<double>(bin) + offset) * kBandBinWidth);
        const SearchTree::Bands bands = tree.bands(level, node);
        const double u = QuantizedRange::unit(bands.scale);
        const double near = std::min(hit.wall, hit.open), slack = 2e-3;
        EXPECT_LE(bands.near_low[bin] * u, near + slack);
        if (bands.wall_high[bin] < QuantizedRange::kGreatest) {
          EXPECT_GE(bands.wall_high[bin] * u, hit.wall - slack);
        }
        const auto is_in_gap = [&](double range) {
          return range > bands.gap_low[bin] * u + slack && range < bands.gap_high[bin] * u - slack;
        };
        gaps += bands.gap_low[bin] < bands.gap_high[bin];
        EXPECT_FALSE(is_in_gap(hit.wall));
        EXPECT_FALSE(is_in_gap(near));
        if (std::isfinite(hit.open)) {
          EXPECT_TRUE(bands.has_open);
          EXPECT_EQ(bands.gap_low[bin] & 1, 1);
        }
      }
    }
  }
  EXPECT_GT(gaps, 300U);
}

TEST(SearchTree, TellsNoGapThatBeginsBeyondTheGreatestByte) {
  // A room, told in the finest unit, with a door to a corridor. Of a bin that looks along its upper
  // wall the ranges go on to where the wall ends, at 8.2 m, and from there to the back of a niche:
  // the gap between begins beyond 7.97 m, the greatest byte, and 7.95 m lies on the wall.
  const TreeOfMap built(mapOf({{-3, -3},
                               {3, -3},
                               {3, 0},
                               {20, 0},
                               {20, 3.6},
                               {8.2, 3.6},
                               {8.2, 0.6},
                               {3, 0.6},
                               {3, 3},
                               {-3, 3}}));
  const SearchTree& tree = built.tree;
  std::mt19937 random(15);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t near_the_limit = 0;
  for (std::size_t leaf = 0; leaf < tree.nodes(0).size(); ++leaf) {
    const SearchTree::Bands bands = tree.bands(0, leaf);
    const TPoint2D p = tree.middle(leaf);
    if (bands.scale != 0 || std::hypot(p.x, p.y) > 2.0) continue;
    for (std::size_t bin = 0; bin < 5; ++bin) {
      for (int i = 0; i < 200; ++i) {
        const double angle = (static_cast<double>(bin) + unit(random)) * kBandBinWidth;
        const double wall = built.rays.cast(p, angle).wall / QuantizedRange::kFinestUnit;
        if (wall < 254.1 || wall > 254.9) continue;
        ++near_the_limit;
        EXPECT_FALSE(wall > bands.gap_low[bin] && wall < bands.gap_high[bin])
            << p.x << " " << p.y << ", bin " << bin;
      }
    }
  }
  EXPECT_GT(near_the_limit, 20U);
}

TEST(SearchTree, EveryLevelHoldsEveryCellOnce) {
  std::mt19937 random(12);
  const TreeOfMap built(floorPlan(randomParams(random), 2));
  const SearchTree& tree = built.tree;
  double area = 0.0;
  for (std::size_t leaf = 0; leaf < tree.nodes(0).size(); ++leaf) {
    area += signedArea({tree.polygon(leaf), tree.polygon(leaf) + tree.polygonSize(leaf)});
  }
  EXPECT_NEAR(area, built.map.area(), 1e-5 * built.map.area());
  for (std::size_t level = 0; level < SearchTree::kLevels; ++level) {
    std::size_t next = 0;
    const double width = std::ldexp(TreeOfMap::kSize, static_cast<int>(level));
    for (std::size_t node = 0; node < tree.nodes(level).size(); ++node) {
      const auto [first, last] = cellsOf(tree, level, node);
      EXPECT_EQ(first, next);
      next = last;
      const BoundingBox& box = tree.box(level, node);
      EXPECT_LE(box.max.x - box.min.x, width + 1e-9);
      EXPECT_LE(box.max.y - box.min.y, width + 1e-9);
      for (std::size_t leaf = first; leaf < last; ++leaf) {
        for (std::size_t k = 0; k < tree.polygonSize(leaf); ++k) {
          const TPoint2D& p = tree.polygon(leaf)[k];
          EXPECT_TRUE(p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y);
        }
      }
    }
    EXPECT_EQ(next, tree.nodes(0).size());
  }
}

TEST(SearchTree, ViewsFromTheMiddleArePredictedRanges) {
  std::mt19937 random(13);
  const TreeOfMap built(floorPlan(randomParams(random), 4));
  std::size_t apart = 0, compared = 0;
  for (std::size_t leaf = 0; leaf < built.tree.nodes(0).size(); leaf += 3) {
    const SearchTree::View view = built.tree.middleView(leaf);
    for (std::size_t bin = 0; bin < kBandBins; bin += 5) {
      const RayHit hit =
          built.rays.cast(built.tree.middle(leaf), static_cast<double>(bin) * kBandBinWidth);
      ++compared;
      const double near = view.near[bin] * SearchTree::kViewUnit;
      const double wall = view.wall[bin] * SearchTree::kViewUnit;
      const double most = 511.99;  // of 16 bits
      apart += std::abs(near - std::min({hit.wall, hit.open, most})) > 0.01 ||
               std::abs(wall - std::min(hit.wall, most)) > 0.01;
    }
  }
  EXPECT_LT(static_cast<double>(apart), 5e-3 * static_cast<double>(compared));  // grazing rays
}

TEST(SearchTree, DoesNotDependOnTheThreads) {
  std::mt19937 random(14);
  const PolygonMap map = floorPlan(randomParams(random), 6);
  const TreeOfMap one(map, 1), many(map, 4);
  for (std::size_t level = 0; level < SearchTree::kLevels; ++level) {
    EXPECT_EQ(one.tree.data().levels[level].codes, many.tree.data().levels[level].codes);
  }
  EXPECT_EQ(one.tree.data().views, many.tree.data().views);
}

TEST(SearchTree, RefusesDataThatDoNotFitTogether) {
  const TreeOfMap built(squareMap(2.0));
  const auto refuses = [&](const auto& spoil) {
    SearchTree::Data data = built.tree.data();
    spoil(data);
    EXPECT_THROW(SearchTree{std::move(data)}, InvalidMapError);
  };
  EXPECT_NO_THROW(SearchTree{built.tree.data()});
  refuses([](SearchTree::Data& d) { d.leaf_size = 0.0; });
  refuses([](SearchTree::Data& d) { d.first_vertex.back() += 1; });
  refuses([](SearchTree::Data& d) { d.views.pop_back(); });
  refuses([](SearchTree::Data& d) { d.levels[1].nodes.back().scale = 99; });
  refuses([](SearchTree::Data& d) { d.levels[0].codes.pop_back(); });
  refuses([](SearchTree::Data& d) { d.levels[1].boxes.pop_back(); });
  refuses([](SearchTree::Data& d) { d.levels[2].nodes.back().child_count += 100; });
  refuses([](SearchTree::Data& d) { d.levels[2].nodes.back().child_count = 0; });
  refuses([](SearchTree::Data& d) { d.levels[1].nodes.back().first_child -= 1; });
  refuses([](SearchTree::Data& d) { d.levels[0].boxes.front().max.x += 1e-9; });
  refuses([](SearchTree::Data& d) { d.levels[3].boxes.front().min.y -= 1.0; });
  refuses([](SearchTree::Data& d) { d.vertices[1].x = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](SearchTree::Data& d) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    d.vertices[0].x = kInfinity;
    for (SearchTree::Level& level : d.levels) level.boxes.front().max.x = kInfinity;
  });
}

}  // namespace
}  // namespace mrpt_polyloc::test
