#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/geometry/convex_pieces.h>
#include <mrpt_polyloc/localization/search/RangeBands.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace mrpt_polyloc::test {
namespace {

/// A map with the bands' index over squares four times as large as the leaves.
struct MapWithBands {
  explicit MapWithBands(PolygonMap polygon_map, double size)
      : map(std::move(polygon_map)),
        triangulation(map),
        index(triangulation, 4 * size, 1),
        leaves(convexPieces(triangulation, triangulation.box().min, size, 1)),
        rays(map) {}

  PolygonMap map;
  Triangulation triangulation;
  VisibleEdgeIndex index;
  ConvexPieces leaves;
  BruteForceRays rays;
};

/// A random point of a convex polygon, often on its border or at a vertex.
TPoint2D pointIn(const TPoint2D* polygon, std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::size_t corners = unit(random) < 0.5 ? 2 : count;
  const std::size_t start = random() % count;
  double sum = 0.0;
  TPoint2D p{0, 0};
  for (std::size_t k = 0; k < corners; ++k) {
    const double weight = -std::log(unit(random) + 1e-12);
    p += polygon[(start + k) % count] * weight;
    sum += weight;
  }
  return p * (1.0 / sum);
}

/// The box of all leaves in the block of two by two squares that holds a leaf's.
BoundingBox blockOf(const MapWithBands& built, const ConvexPieces::Piece& leaf) {
  BoundingBox box = BoundingBox::empty();
  for (const ConvexPieces::Piece& other : built.leaves.pieces) {
    if (other.column >> 1 != leaf.column >> 1 || other.row >> 1 != leaf.row >> 1) continue;
    for (std::uint32_t k = 0; k < other.count; ++k) {
      box.include(built.leaves.vertices[other.first + k]);
    }
  }
  return box;
}

/// How a band holds what is seen from points of its leaf.
struct BandTally {
  std::size_t rays = 0;
  std::size_t outside = 0;
  std::size_t in_gaps = 0;  ///< bins that have one
  std::size_t cut = 0;      ///< rays to walls farther than the least bound by more than 5 m
  double worst = 0.0;       ///< how far outside [m]
};

void expectWithin(double range, float low, float high, BandTally& tally) {
  // Single precision, and points rounded to the chains' grid.
  const double slack = 1e-3 + 1e-4 * (std::isfinite(range) ? range : 0.0);
  ++tally.rays;
  const double off = std::max(static_cast<double>(low) - range, range - static_cast<double>(high));
  if (!(off > slack)) return;
  ++tally.outside;
  tally.worst = std::max(tally.worst, off);
}

/// Nothing is first met at `range` within a gap.
void expectOutside(double range, float low, float high, BandTally& tally) {
  const double slack = 1e-3 + 1e-4 * (std::isfinite(range) ? range : 0.0);
  const double off = std::min(range - static_cast<double>(low), static_cast<double>(high) - range);
  if (!(off > slack)) return;
  ++tally.outside;
  tally.worst = std::max(tally.worst, off);
}

enum class Lists { of_index, narrowed };

BandTally checkCells(const MapWithBands& built, std::size_t leaves, std::uint32_t seed,
                     Lists lists) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RangeBandFinder finder(built.index);
  RangeBands bands;
  BandTally tally;
  for (std::size_t i = 0; i < leaves; ++i) {
    const auto& leaf = built.leaves.pieces[random() % built.leaves.pieces.size()];
    const TPoint2D* polygon = &built.leaves.vertices[leaf.first];
    if (lists == Lists::narrowed) finder.narrow(blockOf(built, leaf));
    finder.find(polygon, leaf.count, bands);
    TPoint2D middle{0, 0};
    for (std::size_t k = 0; k < leaf.count; ++k) {
      middle += polygon[k] * (1.0 / static_cast<double>(leaf.count));
    }
    for (int k = 0; k < 60; ++k) {
      // A little inside: on the border itself the nearest wall may be on either side.
      const TPoint2D p = middle + (pointIn(polygon, leaf.count, random) - middle) * (1.0 - 1e-5);
      const std::size_t bin = random() % kBandBins;
      const double angle = (static_cast<double>(bin) + unit(random)) * kBandBinWidth;
      const RayHit hit = built.rays.cast(p, angle);
      expectWithin(hit.wall, bands.wall_low[bin], bands.wall_high[bin], tally);
      if (std::isfinite(hit.open)) {
        expectWithin(hit.open, bands.open_low[bin], std::numeric_limits<float>::infinity(), tally);
      }
      expectWithin(std::min(hit.open, hit.wall), std::min(bands.open_low[bin], bands.wall_low[bin]),
                   std::min(bands.open_high[bin], bands.wall_high[bin]), tally);
      tally.cut += hit.wall > bands.wall_low[bin] + 5.0F && std::isinf(bands.wall_high[bin]);
      tally.in_gaps += bands.gap_high[bin] > bands.gap_low[bin];
      expectOutside(hit.wall, bands.gap_low[bin], bands.gap_high[bin], tally);
      expectOutside(std::min(hit.open, hit.wall), bands.gap_low[bin], bands.gap_high[bin], tally);
    }
  }
  return tally;
}

TEST(RangeBands, HoldWhatIsSeenInNamedMaps) {
  for (const auto& [name, map] : namedMaps()) {
    for (const double open_share : {0.0, 0.4}) {
      SCOPED_TRACE(std::string(name) + (open_share > 0 ? " with open edges" : ""));
      const MapWithBands built(open_share > 0 ? withOpenEdges(map, open_share, 3) : map, 0.2);
      for (const Lists lists : {Lists::of_index, Lists::narrowed}) {
        const BandTally tally = checkCells(built, 60, 1, lists);
        EXPECT_EQ(tally.outside, 0U) << "of " << tally.rays << ", by " << tally.worst << " m";
      }
    }
  }
}

TEST(RangeBands, HoldWhatIsSeenInRandomMaps) {
  std::mt19937 random(4);
  std::size_t gaps = 0, rays = 0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const MapWithBands built(floorPlan(randomParams(random), seed), seed % 2 == 0 ? 0.2 : 0.4);
    for (const Lists lists : {Lists::of_index, Lists::narrowed}) {
      const BandTally tally = checkCells(built, 80, seed, lists);
      EXPECT_EQ(tally.outside, 0U) << "of " << tally.rays << ", by " << tally.worst << " m";
      gaps += tally.in_gaps;
      rays += tally.rays;
    }
  }
  EXPECT_GT(gaps, rays / 50);  // else they were not tested
}

/// Walls of pieces with gaps between, several deep: most bins are blocked by none of them, and
/// lists end within the map.
TEST(RangeBands, HoldWhatIsSeenThroughBrokenWalls) {
  std::vector<std::vector<TPoint2D>> holes;
  for (int wall = 0; wall < 5; ++wall) {
    for (int piece = 0; piece < 20; ++piece) {
      const double x = 3.0 * wall + 2.5, y = 0.5 + 0.6 * piece + 0.1 * (wall % 3);
      holes.push_back(rectangle(x, y, x + 0.1, y + 0.35));
    }
  }
  const PolygonMap map = mapOf(rectangle(0, 0, 18, 13), holes);
  std::size_t cut = 0;
  for (const double open_share : {0.0, 0.5}) {
    SCOPED_TRACE(open_share);
    const MapWithBands built(open_share > 0 ? withOpenEdges(map, open_share, 5) : map, 0.25);
    const BandTally tally = checkCells(built, 300, 2, Lists::narrowed);
    EXPECT_EQ(tally.outside, 0U) << "of " << tally.rays << ", by " << tally.worst << " m";
    cut += tally.cut;
  }
  EXPECT_GT(cut, 1000U);  // else it was not tested
}

TEST(RangeBands, AreAsTightWhereTheirEdgesWereNarrowedDown) {
  std::mt19937 random(6);
  std::size_t bins = 0, wider = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const MapWithBands built(floorPlan(randomParams(random), seed), 0.25);
    RangeBandFinder from_all(built.index), from_few(built.index);
    RangeBands all, few;
    for (std::size_t i = 0; i < 60; ++i) {
      const auto& leaf = built.leaves.pieces[random() % built.leaves.pieces.size()];
      const TPoint2D* polygon = &built.leaves.vertices[leaf.first];
      from_all.find(polygon, leaf.count, all);
      from_few.narrow(blockOf(built, leaf));
      from_few.find(polygon, leaf.count, few);
      for (std::size_t b = 0; b < kBandBins; ++b) {
        ++bins;
        wider += few.wall_low[b] < all.wall_low[b] * (1.0F - 1e-4F) ||
                 few.wall_high[b] > all.wall_high[b] * (1.0F + 1e-4F) ||
                 few.gap_high[b] - few.gap_low[b] < all.gap_high[b] - all.gap_low[b] - 0.01F;
      }
    }
  }
  EXPECT_LT(wider, bins / 500);
}

TEST(RangeBands, TellANearWallFromWhatIsSeenPastItsEnd) {
  // From the left, the bin past the tip of the screen shows the screen at 2 m or the wall at 6 m.
  const PolygonMap map = mapOf(rectangle(-4, -4, 6, 4), {rectangle(2.0, -4.0 + 1e-3, 2.05, 0.0)});
  const MapWithBands built(map, 0.25);
  const TPoint2D leaf[] = {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}};
  RangeBands bands;
  RangeBandFinder(built.index).find(leaf, 4, bands);
  for (const std::size_t bin : {std::size_t{0}, kBandBins - 1}) {
    EXPECT_NEAR(bands.wall_low[bin], 1.95, 0.01);
    EXPECT_NEAR(bands.wall_high[bin], 6.06, 0.02);
    EXPECT_NEAR(bands.gap_low[bin], 2.1, 0.05);
    EXPECT_NEAR(bands.gap_high[bin], 5.95, 0.01);
  }
  EXPECT_EQ(bands.gap_high[kBandBins / 2], 0.0F);  // one wall alone
}

}  // namespace
}  // namespace mrpt_polyloc::test
