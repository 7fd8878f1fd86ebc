#include "tests/support/constants.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/ChangedWorld.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using test::kInfinity;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A hall of 10 m x 4 m with a pillar of 1 m2 in its left half, and an open edge in the middle of
/// the upper side.
PolygonMap hall() {
  Ring outer = wallRing({{0, 0}, {10, 0}, {10, 4}, {6, 4}, {4, 4}, {0, 4}});
  outer.kinds[3] = EdgeKind::open;
  return PolygonMap({{outer, {wallRing({{2, 1}, {2, 2}, {3, 2}, {3, 1}})}}}, {{{4, 7}, {6, 7}}});
}

ChangedWorld world(const WorldChanges& changes, std::uint64_t seed = 1) {
  return ChangedWorld(hall(), changes, seed);
}

TEST(ChangedWorld, UnchangedIsTheMap) {
  const WallSegments walls(hall());
  const ChangedWorld same = world({});
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const TPoint2D place{random.uniform(0, 10), random.uniform(0, 4)};
    const double direction = random.uniform(-kPi, kPi);
    ASSERT_EQ(same.range(place, direction, 0.3), walls.range(place, direction)) << i;
  }
  const mrpt::math::TPose2D pose(9, 3, 1);
  EXPECT_EQ(same.worldPose(pose), pose);
}

TEST(ChangedWorld, ManyBeamsAreWhatEachIsByItself) {
  WorldChanges changed;
  changed.boxes = 20;
  changed.wall_shift = 0.05;
  changed.wing_turn = 0.1;
  changed.glass = 0.3;
  Random random(6);
  for (const WorldChanges& changes : {WorldChanges{}, changed}) {
    const ChangedWorld room = world(changes);
    for (int i = 0; i < 600; ++i) {
      // Anywhere, or at a corner, on a wall and on the line of one, up to the least step away.
      TPoint2D place{random.uniform(-1, 11), random.uniform(-1, 5)};
      if (i % 4 == 1) place = {i % 8 < 4 ? 2.0 : 10.0, i % 16 < 8 ? 1.0 : 0.0};
      if (i % 4 == 2) place.y = i % 8 < 4 ? 0.0 : 2.0;
      if (i % 12 == 5) place.x += 1e-9;
      if (i % 12 == 6) place.y = std::nextafter(place.y, 3.0);
      const double heading = i % 3 == 0 ? 0.5 * kPi * (i % 5) : random.uniform(-9, 9);
      const double fov = i % 2 == 0 ? kTwoPi * 359 / 360 : random.uniform(0.01, 6.0);
      std::vector<double> bearings;
      for (int k = 0; k < 180; ++k) bearings.push_back(-0.5 * fov + fov * k / 179.0);
      const std::vector<double> ranges = room.ranges(place, heading, bearings, 0.3);
      for (std::size_t k = 0; k < bearings.size(); ++k) {
        ASSERT_EQ(ranges[k], room.range(place, heading + bearings[k], 0.3)) << i << " " << k;
      }
    }
    EXPECT_TRUE(room.ranges({5, 2}, 0.0, {}, 0.3).empty());
    EXPECT_EQ(room.ranges({5, 2}, 0.4, {0.0}, 0.3).front(), room.range({5, 2}, 0.4, 0.3));
  }
}

TEST(ChangedWorld, ObstaclesThatAreGoneLetBeamsPass) {
  WorldChanges changes;
  changes.gone = 1.0;
  EXPECT_NEAR(world({}).range({1, 1.5}, 0, 0), 1.0, 1e-12);
  EXPECT_NEAR(world(changes).range({1, 1.5}, 0, 0), 9.0, 1e-12);
  // Only what is all wall, and small enough, can be carried away.
  Ring pillar = wallRing({{2, 0.5}, {2, 3.5}, {4, 3.5}, {4, 0.5}});  // 6 m2
  const PolygonMap large({{wallRing({{0, 0}, {10, 0}, {10, 4}, {0, 4}}), {pillar}}});
  EXPECT_NEAR(ChangedWorld(large, changes, 1).range({1, 1.5}, 0, 0), 1.0, 1e-12);
}

TEST(ChangedWorld, WallsStandAsideByTheStatedDeviation) {
  WorldChanges changes;
  changes.wall_shift = 0.05;
  double sum = 0.0, squares = 0.0, most = 0.0;
  constexpr int kWorlds = 3000;
  for (int seed = 0; seed < kWorlds; ++seed) {
    const double range =
        world(changes, static_cast<std::uint64_t>(seed)).range({5, 1}, -kPi / 2, 0);
    sum += range - 1.0;
    squares += (range - 1.0) * (range - 1.0);
    most = std::max(most, std::abs(range - 1.0));
  }
  EXPECT_NEAR(sum / kWorlds, 0.0, 5 * 0.05 / std::sqrt(kWorlds));
  EXPECT_NEAR(std::sqrt(squares / kWorlds), 0.05, 0.05 * 0.07);
  EXPECT_LE(most, 0.15 + 1e-9);
}

TEST(ChangedWorld, AWingIsScaledAndTurnedWithThePosesInIt) {
  WorldChanges changes;
  changes.wing_scale = 0.1;
  const ChangedWorld longer = world(changes);
  EXPECT_NEAR(longer.range({5, 2}, 0, 0), 5.5, 1e-9);
  EXPECT_NEAR(longer.range({1, 3}, kPi, 0), 1.0, 1e-9);  // the other wing is as it was
  const auto moved = longer.worldPose({9, 2, 0.3});
  EXPECT_NEAR(moved.x, 9.4, 1e-12);
  EXPECT_NEAR(moved.phi, 0.3, 1e-12);

  // The box has its middle at (5, 3.5), for the wall beyond reaches up to 7.
  changes = {};
  changes.wing_turn = 0.1;
  const ChangedWorld turned = world(changes);
  const auto pose = turned.worldPose({9, 3.5, 0.0});
  EXPECT_NEAR(pose.x, 5 + 4 * std::cos(0.1), 1e-12);
  EXPECT_NEAR(pose.y, 3.5 + 4 * std::sin(0.1), 1e-12);
  EXPECT_NEAR(pose.phi, 0.1, 1e-12);
  // Seen from there, straight ahead, the end of the hall is as far as in the map.
  EXPECT_NEAR(turned.range({pose.x, pose.y}, pose.phi, 0), 1.0, 1e-9);
}

TEST(ChangedWorld, GlassIsSeenStraightOnAlone) {
  WorldChanges changes;
  changes.glass = 1.0;
  const ChangedWorld glass = world(changes);
  EXPECT_NEAR(glass.range({8, 2}, 0, 0), 2.0, 1e-12);
  EXPECT_NEAR(glass.range({8, 2}, 14.9 * kPi / 180, 0), 2.0 / std::cos(14.9 * kPi / 180), 1e-9);
  EXPECT_EQ(glass.range({8, 2}, 15.1 * kPi / 180, 0), kInfinity);
  changes.glass = 0.3;
  int passed = 0;
  constexpr int kWorlds = 3000;
  for (int seed = 0; seed < kWorlds; ++seed) {
    passed += world(changes, static_cast<std::uint64_t>(seed)).range({8, 2}, 0.4, 0) == kInfinity;
  }
  EXPECT_NEAR(static_cast<double>(passed) / kWorlds, 0.3, 5 * std::sqrt(0.21 / kWorlds));
}

TEST(ChangedWorld, BoxesStandInTheWayButNotOnTheRobot) {
  WorldChanges changes;
  changes.boxes = 60;
  const ChangedWorld full = world(changes);
  const WallSegments walls(hall());
  EXPECT_EQ(full.boxCount(), 60u);
  Random random(9);
  int blocked = 0;
  constexpr int kBeams = 3000;
  for (int i = 0; i < kBeams; ++i) {
    const TPoint2D place{random.uniform(4, 9.5), random.uniform(0.5, 3.5)};
    const double direction = random.uniform(-kPi, kPi);
    const double range = full.range(place, direction, 0.3), empty = walls.range(place, direction);
    ASSERT_LE(range, empty);
    if (range < empty) {
      ASSERT_GE(range, 0.3 - 1e-9);
      ++blocked;
    }
  }
  EXPECT_GT(blocked, kBeams / 3);
  // Where everything is nearer than the clearance all boxes are left out.
  EXPECT_EQ(full.range({5, 2}, 0.2, 50.0), walls.range({5, 2}, 0.2));
}

TEST(ChangedWorld, TheSameSeedGivesTheSameWorldAndKindsDoNotMeddle) {
  WorldChanges changes;
  changes.wall_shift = 0.05;
  changes.boxes = 3;
  const ChangedWorld a = world(changes, 4), b = world(changes, 4), c = world(changes, 5);
  EXPECT_EQ(a.range({5, 1}, 0.3, 0), b.range({5, 1}, 0.3, 0));
  EXPECT_NE(a.range({5, 1}, -1.5, 0), c.range({5, 1}, -1.5, 0));
  changes.boxes = 0;
  changes.gone = 1.0;
  changes.glass = 0.5;
  EXPECT_EQ(a.range({5, 1}, -kPi / 2, 9), world(changes, 4).range({5, 1}, -kPi / 2, 9));
}

TEST(ChangedWorld, BadChangesAreNamed) {
  const auto expectRefused = [](auto change, const char* field) {
    WorldChanges changes;
    change(changes);
    EXPECT_THAT([&] { world(changes); }, ThrowsMessage<InvalidParamsError>(HasSubstr(field)));
  };
  expectRefused([](auto& c) { c.gone = 1.5; }, "gone");
  expectRefused([](auto& c) { c.wall_shift = -1; }, "wall_shift");
  expectRefused([](auto& c) { c.wing_scale = 3; }, "wing_scale");
  expectRefused([](auto& c) { c.wing_turn = 4; }, "wing_turn");
  expectRefused([](auto& c) { c.glass = std::nan(""); }, "glass");
}

}  // namespace
}  // namespace mrpt_polyloc
