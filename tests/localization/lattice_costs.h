#pragma once

#include "simulated_scans.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/SignatureQuery.h>
#include <mrpt_polyloc/localization/search_positions.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mrpt_polyloc::test {

/// A small building with open edges and the pyramid over it.
struct PyramidOfMap {
  /// No border lies on the lattice: positions on a wall see out of the map, or not.
  static constexpr double kSpacing = 0.23;

  explicit PyramidOfMap(PolygonMap polygon_map)
      : map(std::move(polygon_map)),
        triangulation(map),
        predictor(triangulation, RangePredictor::kCellSize, 1),
        pyramid(predictor, searchPositions(triangulation, kSpacing), triangulation.box().min,
                kSpacing, 1) {}

  PolygonMap map;
  Triangulation triangulation;
  RangePredictor predictor;
  SignaturePyramid pyramid;
};

inline PolygonMap smallBuilding(std::uint32_t seed) {
  FloorPlanParams params;
  params.rooms_per_side = 1 + static_cast<int>(seed % 2);
  params.room_width = 3.5;
  params.room_depth = 3.0;
  params.furniture_per_room = 2;
  params.unknown_share = seed % 3 == 0 ? 0.0 : 1.0;
  params.crossing_walls = seed % 2 == 0 ? 1 : 0;
  params.rotation = 0.4 * seed;
  return floorPlan(params, seed);
}

/// A scan from somewhere in the map: with noise, beams that end early and ones without return, and
/// for odd seeds of part of the circle.
inline RangeScan roughScan(const PolygonMap& map, std::uint32_t seed,
                           const TPoint2D& sensor = {0, 0}) {
  std::mt19937 random(seed);
  const TPoint2D p = randomFreePoints(map, 1, random).front();
  ScanOptions options;
  options.beams = 200;
  options.field_of_view = seed % 2 == 0 ? 2 * kPi : 0.8 * kPi;
  options.max_range = 5.0;
  options.sigma = 0.02;
  options.short_share = 0.1;
  options.seed = seed;
  options.sensor = sensor;
  return simulatedScan(map, {p.x, p.y, std::uniform_real_distribution<double>(-3, 3)(random)},
                       options);
}

/// bandCost() of a position, rule by rule and bin by bin: the oracle.
inline unsigned naiveCost(const SignatureBand& leaf, const SignatureQuery& query,
                          std::size_t heading) {
  int sum = 0;
  for (std::size_t beam = 0; beam < kBins; ++beam) {
    const std::size_t direction = (beam + heading) % kBins;
    const int z = query.range[beam], near = leaf.near_low[direction];
    const int wall = leaf.wall_low[direction];
    if (z >= wall) {
      sum += std::min<int>(z - wall, query.cap_long[beam]);
    } else if (z >= near) {
      sum += std::min<int>(wall - z, query.cap_open[beam]);
    } else {
      sum += std::min<int>(near - z, query.cap_short[beam]);
    }
  }
  return static_cast<unsigned>(sum);
}

/// The naive costs of all positions and headings: costs[position * kBins + heading].
inline std::vector<unsigned> latticeCosts(const SignaturePyramid& pyramid,
                                          const SignatureQuery& query) {
  std::vector<unsigned> costs;
  for (std::size_t i = 0; i < pyramid.blocks(0).size(); ++i) {
    for (std::size_t heading = 0; heading < kBins; ++heading) {
      costs.push_back(naiveCost(pyramid.band(0, i), query, heading));
    }
  }
  return costs;
}

}  // namespace mrpt_polyloc::test
