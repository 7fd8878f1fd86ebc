#include "tests/support/constants.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using test::kInfinity;

/// A room of 4 m x 3 m whose right side is open, a pillar in it and a wall beyond the open side.
PolygonMap pillarRoom() {
  Ring outer{{{0, 0}, {4, 0}, {4, 3}, {0, 3}},
             {EdgeKind::wall, EdgeKind::open, EdgeKind::wall, EdgeKind::wall}};
  const Ring pillar = wallRing({{1, 1}, {1, 2}, {2, 2}, {2, 1}});
  return PolygonMap({{outer, {pillar}}}, {{{6, -1}, {6, 1.5}}});
}

TEST(WallSegments, FindsTheFirstWallInEveryDirection) {
  const WallSegments walls(pillarRoom());
  EXPECT_DOUBLE_EQ(walls.range({0.5, 1.5}, 0.0), 0.5);                   // the pillar
  EXPECT_DOUBLE_EQ(walls.range({0.5, 1.5}, kPi), 0.5);                   // the wall behind
  EXPECT_NEAR(walls.range({0.5, 0.5}, kPi / 4), std::sqrt(0.5), 1e-12);  // the pillar's corner
  EXPECT_NEAR(walls.range({3.0, 0.5}, kPi / 2), 2.5, 1e-12);
}

TEST(WallSegments, PassesOpenEdgesAndStopsAtWallsBeyond) {
  const WallSegments walls(pillarRoom());
  EXPECT_DOUBLE_EQ(walls.range({3.0, 1.0}, 0.0), 3.0);
  EXPECT_EQ(walls.range({3.0, 2.0}, 0.0), kInfinity);  // above the end of the wall beyond
}

TEST(WallSegments, MeetsEndPointsAndWallsAlongTheBeam) {
  const WallSegments walls(pillarRoom());
  EXPECT_DOUBLE_EQ(walls.range({3.0, 1.5}, 0.0), 3.0);  // the wall's upper end
  // Along the lower wall, from outside and from on it.
  EXPECT_DOUBLE_EQ(walls.range({-1.0, 0.0}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(walls.range({2.0, 0.0}, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(walls.range({6.0, 1.0}, 0.0), 0.0);
}

TEST(WallSegments, DistanceIsToTheNearestWallNotOpenEdge) {
  const WallSegments walls(pillarRoom());
  EXPECT_DOUBLE_EQ(walls.distance({0.5, 1.5}), 0.5);
  EXPECT_DOUBLE_EQ(walls.distance({3.9, 1.5}), 1.5);  // the open side at 0.1 m does not count
  EXPECT_DOUBLE_EQ(walls.distance({9.0, 5.5}), 5.0);  // from the end of the wall beyond
}

TEST(WallSegments, AMapWithoutWallsHasNone) {
  const Ring open{{{0, 0}, {1, 0}, {0, 1}}, {EdgeKind::open, EdgeKind::open, EdgeKind::open}};
  const WallSegments walls(PolygonMap({{open, {}}}));
  EXPECT_EQ(walls.range({0.2, 0.2}, 1.0), kInfinity);
  EXPECT_EQ(walls.distance({0.2, 0.2}), kInfinity);
}

/// Oracle: steps of a tenth of a millimetre until a closed polygon is left.
TEST(WallSegments, AgreesWithMarchingInAConvexRoom) {
  std::vector<TPoint2D> corners;
  for (int i = 0; i < 7; ++i) corners.push_back({3 * std::cos(0.9 * i), 2 * std::sin(0.9 * i)});
  const PolygonMap map({{wallRing(corners), {}}});
  const WallSegments walls(map);
  for (int k = 0; k < 40; ++k) {
    const double direction = 0.157 * k - kPi;
    const TPoint2D origin{0.3 * std::cos(1.7 * k), 0.3 * std::sin(2.3 * k)};
    double marched = 0.0;
    while (map.contains(
        {origin.x + marched * std::cos(direction), origin.y + marched * std::sin(direction)})) {
      marched += 1e-4;
    }
    EXPECT_NEAR(walls.range(origin, direction), marched, 2e-4) << "beam " << k;
  }
}

TEST(WallSegments, DiscsStandInTheWay) {
  RoomChanges changes;
  changes.discs = {{{3.0, 1.5}, 0.25}};
  const WallSegments walls(pillarRoom(), changes);
  EXPECT_NEAR(walls.range({3.0, 0.5}, kPi / 2), 0.75, 1e-12);
  EXPECT_NEAR(walls.range({3.0, 0.5}, -kPi / 2), 0.5, 1e-12);  // behind: the wall
  // Past its rim by a hair, and just not.
  EXPECT_NEAR(walls.range({3.251, 0.5}, kPi / 2), 2.5, 1e-12);
  EXPECT_NEAR(walls.range({3.249, 0.5}, kPi / 2), 1.0 - std::sqrt(0.0625 - 0.249 * 0.249), 1e-9);
  EXPECT_EQ(walls.range({3.1, 1.5}, 1.0), 0.0);  // from within
  EXPECT_EQ(walls.distance({3.1, 1.5}), 0.0);
  EXPECT_NEAR(walls.distance({3.0, 0.9}), 0.35, 1e-12);
}

TEST(WallSegments, AMovedWallIsTheNearestOne) {
  RoomChanges changes;
  changes.moved = {{{1.5, 2.9}, {0.0, -0.4}}};  // the upper wall
  const WallSegments walls(pillarRoom(), changes);
  EXPECT_NEAR(walls.range({3.0, 0.5}, kPi / 2), 2.1, 1e-12);
  EXPECT_NEAR(walls.range({3.0, 0.5}, -kPi / 2), 0.5, 1e-12);
  EXPECT_NEAR(walls.range({0.5, 1.5}, 0.0), 0.5, 1e-12);  // the pillar stands where it stood
}

TEST(WallSegments, RefusesBadChanges) {
  const auto refused = [](const RoomChanges& changes) {
    EXPECT_THROW(WallSegments(pillarRoom(), changes), InvalidParamsError);
  };
  refused({{{{1.0, 1.0}, 0.0}}, {}});
  refused({{{{std::nan(""), 1.0}, 1.0}}, {}});
  refused({{}, {{{1.0, kInfinity}, {0.0, 1.0}}}});
  refused({{}, {{{1.0, 1.0}, {0.0, std::nan("")}}}});
}

}  // namespace
}  // namespace mrpt_polyloc
