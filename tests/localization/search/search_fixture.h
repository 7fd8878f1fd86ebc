#pragma once

#include "tests/support/brute_force_cost.h"
#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/localization/search/TreeDescent.h>

#include <cstddef>
#include <random>
#include <utility>

/// A map with its search tree, and poses in its leaves.
namespace mrpt_polyloc::test {

struct SearchedMap {
  static constexpr double kLeafSize = 0.25;

  explicit SearchedMap(PolygonMap polygon_map)
      : map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, 4 * kLeafSize, 1),
        tree(triangulation, predictor, {kLeafSize, 1}) {}

  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SearchTree tree;
};

/// All of the top level.
inline TreeDescent::Range allBlocks(const SearchTree& tree) {
  return {0, static_cast<std::uint32_t>(tree.nodes(SearchTree::kLevels - 1).size())};
}

/// A small building with what there is: furniture, unknown patches, walls beyond.
inline PolygonMap smallBuilding(std::uint32_t seed) {
  FloorPlanParams params;
  params.rooms_per_side = 1;
  params.furniture_per_room = 2;
  params.unknown_share = 0.5;
  params.rotation = 0.3 * seed;
  return floorPlan(params, seed);
}

/// A pose, and the (leaf, window of headings) that holds it.
struct HeldPose {
  mrpt::math::TPose2D pose_map_beams;
  std::size_t leaf = 0;
  std::uint32_t heading = 0;  ///< first bin of the window
};

/// A pose in a leaf, its heading at a share in [0, 1) of the circle of bins.
inline HeldPose poseIn(const SearchTree& tree, const BandQuery& query, std::size_t leaf,
                       double heading_share, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 0.98);
  TPoint2D p = tree.middle(leaf);
  p += (tree.polygon(leaf)[random() % tree.polygonSize(leaf)] - p) * unit(random);
  constexpr auto kWindow = static_cast<std::uint32_t>(SearchTree::kWindow[0]);
  const double bin = heading_share * static_cast<double>(kBandBins);
  return {
      {p.x, p.y, query.heading(bin)}, leaf, static_cast<std::uint32_t>(bin) / kWindow * kWindow};
}

/// The leaf nearest to a point: that of a pose which lies in free space.
inline std::size_t leafAt(const SearchTree& tree, const TPoint2D& p) {
  std::size_t nearest = 0;
  double least = 1e9;
  for (std::size_t leaf = 0; leaf < tree.nodes(0).size(); ++leaf) {
    const double d = (tree.middle(leaf) - p).norm();
    if (d < least) least = d, nearest = leaf;
  }
  return nearest;
}

}  // namespace mrpt_polyloc::test
