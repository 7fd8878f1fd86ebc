#include "travel_support.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/travel/ClearanceField.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

/// A square's centre is at most so far from a point in it.
double half(const ClearanceField& field) {
  return 0.5 * std::sqrt(2.0) * field.square() + 1e-4;
}

void expectDistances(const PolygonMap& map, unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const ClearanceField field(map, 0.6);
  std::mt19937 random(seed);
  for (const TPoint2D& p : randomPoints(map, 0.5, 400, random)) {
    const double truth = signedClearance(map, p), found = field.at(p);
    if (truth < -half(field)) {
      EXPECT_EQ(found, 0.0) << p.x << ' ' << p.y;
    } else if (truth > half(field)) {
      EXPECT_NEAR(found, std::min(truth, 0.6), half(field)) << p.x << ' ' << p.y;
    }
  }
}

TEST(ClearanceField, GivesTheDistanceToTheBorder) {
  for (const auto& [name, map] : namedMaps()) {
    SCOPED_TRACE(name);
    expectDistances(map, 1);
  }
  for (unsigned seed = 1; seed <= 10; ++seed) {
    expectDistances(randomMapWithHoles(40, 5, seed, 12.0), seed);
    expectDistances(withOpenEdges(randomSimpleMap(30, seed, 12.0), 0.3, seed), seed);
  }
}

TEST(ClearanceField, IsZeroElsewhere) {
  const ClearanceField field(squareMap(), 0.5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TPoint2D& p : {TPoint2D(-1, 5), TPoint2D(5, 20), TPoint2D(1e30, 5), TPoint2D(nan, 5),
                            TPoint2D(5, nan), TPoint2D(-1e30, -1e30)}) {
    EXPECT_EQ(field.at(p), 0.0);
  }
  EXPECT_THROW(ClearanceField(squareMap(), 0.0), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
