#include "travel_support.h"
#include <mrpt_polyloc/travel/Sight.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tests/support/map_factories.h>
#include <tests/support/random_maps.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// The least part of the way from the sensor to points of a disc that rays leave free, sampled.
bool isDiscInView(const WallSegments& walls, const TPose2D& sensor, const TPoint2D& centre,
                  double radius) {
  for (int ring = 0; ring <= 4; ++ring) {
    for (int k = 0; k < 40; ++k) {
      const double angle = 2.0 * kPi * k / 40;
      const TPoint2D p{centre.x + radius * ring / 4 * std::cos(angle),
                       centre.y + radius * ring / 4 * std::sin(angle)};
      const double dx = p.x - sensor.x, dy = p.y - sensor.y;
      if (walls.range({sensor.x, sensor.y}, std::atan2(dy, dx)) < std::hypot(dx, dy)) return false;
    }
  }
  return true;
}

TEST(Sight, SeesDiscsThatAreInViewAndNoOthers) {
  int seen = 0, unseen = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const PolygonMap map = floorPlan(smallFlat(), seed);
    const WallSegments walls(map);
    std::mt19937 random(seed);
    const TPoint2D at = randomFreePoints(map, 1, random)[0];
    const TPose2D pose(at.x, at.y, 0.7 * seed);
    const Sight sight({{castScan(walls, pose, 720), pose}}, 0.0);
    for (const TPoint2D& p : randomPoints(map, 0.5, 300, random)) {
      const bool claimed = sight.seesDisc(p, 0.25);
      // What neighbouring beams hide between them is below a few centimetres here.
      if (claimed) {
        EXPECT_TRUE(isDiscInView(walls, pose, p, 0.2)) << p.x << ' ' << p.y;
      }
      if (isDiscInView(walls, pose, p, 0.35)) {
        EXPECT_TRUE(claimed) << p.x << ' ' << p.y;
      }
      ++(claimed ? seen : unseen);
    }
  }
  EXPECT_GT(seen, 100);
  EXPECT_GT(unseen, 100);
}

TEST(Sight, SeesNothingBehindTheFieldOfView) {
  const WallSegments walls(squareMap(20.0));
  const TPose2D pose(10, 10, 0);
  const Sight half({{castScan(walls, pose, 180, 30.0, kPi), pose}}, 0.3);
  EXPECT_TRUE(half.seesDisc({13, 10}, 0.3));
  EXPECT_FALSE(half.seesDisc({7, 10}, 0.3));
  EXPECT_FALSE(half.seesDisc({10, 13}, 0.3));  // half of it
  EXPECT_TRUE(half.seesDisc({10, 10}, 0.2)) << "where it stands";
  EXPECT_FALSE(half.seesDisc({9.8, 10}, 0.3));
}

TEST(Sight, TakesNoReturnsAsFreeAndInvalidBeamsAsUnseen) {
  std::vector<Beam> beams;
  for (int i = 0; i < 360; ++i) {
    const double bearing = i * kDegree;
    if (i < 90) beams.push_back({bearing, 5.0, BeamKind::no_return});
    if (i >= 90 && i < 180) beams.push_back({bearing, 0.0, BeamKind::invalid});
    if (i >= 180) beams.push_back({bearing, 2.0, BeamKind::hit});
  }
  const Sight sight({{RangeScan(beams), {0, 0, 0}}}, 0.25);
  EXPECT_TRUE(sight.seesDisc({2.5, 2.5}, 0.3));
  EXPECT_FALSE(sight.seesDisc({4.0, 4.0}, 0.3));
  EXPECT_FALSE(sight.seesDisc({-1.0, 1.0}, 0.3));
  EXPECT_TRUE(sight.seesDisc({-1.0, -1.0}, 0.3));
  EXPECT_FALSE(sight.seesDisc({-2.0, -2.0}, 0.3));
  EXPECT_EQ(sight.hits().size(), 180u);
  EXPECT_FALSE(Sight({}, 0.25).seesDisc({0, 0}, 0.1));
  EXPECT_FALSE(Sight({{RangeScan({}), {0, 0, 0}}}, 0.25).seesDisc({0, 0}, 0.1));
}

TEST(Sight, ForgetsWhatTheNewestScanSeesThrough) {
  const WallSegments walls(squareMap(10.0));
  const TPose2D pose(5, 5, 0);
  // An older scan hit something 2 m ahead and 2 m behind, or its place is not known so well.
  const RangeScan older({{0.0, 2.0, BeamKind::hit}, {kPi, 2.0, BeamKind::hit}});
  const auto hitsAt = [&](const RangeScan& newest, double x) {
    const Sight sight({{newest, {0, 0, 0}}, {older, {0, 0, 0}}}, 0.25);
    return std::any_of(sight.hits().begin(), sight.hits().end(),
                       [&](const TPoint2D& hit) { return std::hypot(hit.x - x, hit.y) < 1e-9; });
  };
  EXPECT_FALSE(hitsAt(castScan(walls, pose, 360), 2.0));
  EXPECT_FALSE(hitsAt(castScan(walls, pose, 360), -2.0));
  const RangeScan ahead = castScan(walls, pose, 181, 30.0, kPi);
  EXPECT_FALSE(hitsAt(ahead, 2.0));
  EXPECT_TRUE(hitsAt(ahead, -2.0)) << "behind the newest scan's laser";
  EXPECT_TRUE(hitsAt(castScan(walls, pose, 60), 2.0)) << "rays may pass a thin leg on both sides";
  // Where the robot stands nothing does, whatever its laser sees.
  const RangeScan beside({{0.0, 0.1, BeamKind::hit}, {0.0, 0.28, BeamKind::hit}});
  const RangeScan blind({{kPi, 1.0, BeamKind::hit}});
  const Sight near({{blind, {0, 0, 0}}, {beside, {0, 0, 0}}}, 0.3);
  EXPECT_EQ(near.hits().size(), 2U);
  // What it hits itself stays, and so does what stands where its rays end.
  EXPECT_EQ(Sight({{castScan(walls, pose, 360), {0, 0, 0}}}, 0.25).hits().size(), 360U);
  EXPECT_EQ(
      Sight({{castScan(walls, pose, 360), {0, 0, 0}}, {castScan(walls, pose, 360), {0, 0, 0}}},
            0.25)
          .hits()
          .size(),
      720U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
