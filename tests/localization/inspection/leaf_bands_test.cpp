#include "tests/support/BruteForceRays.h"
#include "tests/support/map_factories.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/inspection/leaf_bands.h>

#include <gtest/gtest.h>

#include <random>

namespace mrpt_polyloc::test {
namespace {

TEST(LeafBands, HoldWhateverIsSeenFromAnywhereInTheLeaf) {
  for (const PolygonMap& map : {asymmetricRoom(), pillarMap(), windmillMap()}) {
    const MapIndex::Ptr index = MapIndex::build(map);
    const BruteForceRays rays(map);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const BoundingBox& box = map.boundingBox();
    std::size_t looked = 0;
    while (looked < 60) {
      const TPoint2D place(box.min.x + share(random) * (box.max.x - box.min.x),
                           box.min.y + share(random) * (box.max.y - box.min.y));
      const auto leaf = leafBandsAt(*index, place);
      EXPECT_TRUE(leaf || !map.contains(place));
      if (!leaf) continue;
      ++looked;
      ASSERT_GE(leaf->polygon.size(), 3U);
      // A random point of the leaf: a mean of its vertices with random weights.
      TPoint2D point(0, 0);
      double sum = 0.0;
      for (const TPoint2D& vertex : leaf->polygon) {
        const double weight = 0.01 + share(random);
        point = point + vertex * weight;
        sum += weight;
      }
      point = point * (1.0 / sum);
      for (std::size_t b = 0; b < leaf->bins.size(); ++b) {
        const LeafBands::Bin& bin = leaf->bins[b];
        const double angle = (static_cast<double>(b) + 2 * share(random)) * leaf->width;
        const double seen = rays.cast(point, angle).wall;
        EXPECT_GE(seen, bin.near - 1e-6);
        EXPECT_LE(seen, bin.wall + 1e-6);
        const bool has_gap = bin.gap_high > bin.gap_low;
        EXPECT_FALSE(has_gap && seen > bin.gap_low + 1e-6 && seen < bin.gap_high - 1e-6);
      }
    }
  }
}

TEST(LeafBands, NoneOutsideOfFreeSpace) {
  const MapIndex::Ptr index = MapIndex::deferred(pillarMap());
  EXPECT_FALSE(leafBandsAt(*index, {-5, 0}));
  EXPECT_FALSE(leafBandsAt(*index, {2.5, 2.5}));  // within a pillar
  EXPECT_TRUE(leafBandsAt(*index, {1.0, 1.0}));
}

}  // namespace
}  // namespace mrpt_polyloc::test
