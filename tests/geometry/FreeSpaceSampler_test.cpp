#include "tests/support/map_factories.h"
#include <mrpt_polyloc/geometry/FreeSpaceSampler.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

TEST(FreeSpaceSampler, DrawsInFreeSpaceInProportionToArea) {
  constexpr int kDraws = 40'000;
  for (const auto& [name, map] : test::namedMaps()) {
    const FreeSpaceSampler sampler(map);
    Random random(5);
    // Against the brute-force inside test and the share of the left half by rejection sampling.
    const BoundingBox box = map.boundingBox();
    const double middle = 0.5 * (box.min.x + box.max.x);
    int left = 0, rejected_left = 0, rejected = 0;
    for (int i = 0; i < kDraws; ++i) {
      const TPoint2D place = sampler.draw(random);
      if (i < 500) {
        ASSERT_TRUE(map.contains(place)) << name << ": " << place.x << ", " << place.y;
      }
      left += place.x < middle ? 1 : 0;
      const TPoint2D other{random.uniform(box.min.x, box.max.x),
                           random.uniform(box.min.y, box.max.y)};
      if (!map.contains(other)) continue;
      ++rejected;
      rejected_left += other.x < middle ? 1 : 0;
    }
    ASSERT_GT(rejected, 1000) << name;
    const double deviation = 0.5 * std::sqrt(1.0 / kDraws + 1.0 / rejected);
    EXPECT_NEAR(1.0 * left / kDraws, 1.0 * rejected_left / rejected, 5.0 * deviation) << name;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
