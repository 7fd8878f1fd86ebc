#include "tests/support/random_maps.h"
#include <mrpt_polyloc/geometry/NearestWalls.h>
#include <mrpt_polyloc/geometry/WallDistances.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

TEST(WallDistances, EqualThoseToTheNearestWall) {
  std::mt19937 random(81);
  std::size_t near = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const Triangulation triangulation(map);
    const WallDistances distances(triangulation);
    const NearestWalls walls(map);
    for (const TPoint2D& p : test::randomPoints(map, 0.9, 1000, random)) {
      const double exact =
          std::min(std::sqrt(walls.nearest(p)->squared_distance), WallDistances::kReach);
      // Interpolated between corners: a distance is convex beside one wall, concave between two.
      EXPECT_NEAR(distances.at(p.x, p.y), exact, 0.071);
      near += exact < WallDistances::kReach ? 1 : 0;
    }
  }
  EXPECT_GT(near, 3000U);
}

TEST(WallDistances, KnowWallsBeyondAndNoOpenEdges) {
  Ring ring = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  ring.kinds[1] = EdgeKind::open;  // x = 4
  const WallDistances distances(Triangulation(PolygonMap({{ring, {}}}, {{{6, 1}, {6, 3}}})));
  EXPECT_NEAR(distances.at(0.3, 2), 0.3, 1e-3);
  EXPECT_EQ(distances.at(4, 2), WallDistances::kReach);
  EXPECT_NEAR(distances.at(5.8, 2), 0.2, 1e-3);
  EXPECT_NEAR(distances.at(6.0, 2), 0.0, 0.05);
}

TEST(WallDistances, AreTheReachOutsideTheBoxAndNowhere) {
  const WallDistances distances(
      Triangulation(PolygonMap({{wallRing({{0, 0}, {4, 0}, {0, 3}}), {}}})));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TPoint2D& p : {TPoint2D(-9, 1), TPoint2D(1e300, 0), TPoint2D(nan, 1), TPoint2D(1, nan),
                            TPoint2D(1, -std::numeric_limits<double>::infinity())}) {
    EXPECT_EQ(distances.at(p.x, p.y), WallDistances::kReach);
  }
}

TEST(WallDistances, TakeMemoryByTheWalls) {
  // Two rooms 3 km apart.
  Ring far = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), near = far;
  for (TPoint2D& p : far.vertices) p += TPoint2D(3000, 2000);
  const WallDistances distances(Triangulation(PolygonMap({{near, {}}, {far, {}}})));
  EXPECT_LT(distances.bytes(), 1000000U);
  EXPECT_NEAR(distances.at(3000.5, 2002), 0.5, 1e-3);
}

}  // namespace
}  // namespace mrpt_polyloc
