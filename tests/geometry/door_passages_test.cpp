#include "tests/support/map_factories.h"
#include <mrpt_polyloc/geometry/door_passages.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrpt_polyloc::test {
namespace {

RawPolygon room(const std::vector<TPoint2D>& corners) {
  return {wallRing(corners), {}};
}

/// Rooms on both sides of a wall around x = 0, turned and moved.
struct Turned {
  double angle;
  TPoint2D by;

  TPoint2D at(double x, double y) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * x - s * y + by.x, s * x + c * y + by.y};
  }
  RawPolygon room(double x0, double x1) const {
    return {wallRing({at(x0, -5), at(x1, -5), at(x1, 5), at(x0, 5)}), {}};
  }
};

TEST(DoorPassages, FillTheWallAlongTheDoorAndReachIntoBothRooms) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Turned frame{6.28 * unit(random), {100 * unit(random), 100 * unit(random)}};
    const double wall = 0.05 + 0.44 * unit(random), width = 0.6 + unit(random);
    const std::vector<RawPolygon> rooms = {frame.room(-4, 0), frame.room(wall, 5)};
    const double x = wall * unit(random), y = -2.0 + unit(random);
    const auto found = doorPassages(rooms, {{frame.at(x, y), frame.at(x, y + width)}});
    ASSERT_EQ(found.size(), 1U);
    const auto& corners = found[0].outer.vertices;
    EXPECT_GT(signedArea(corners), 0.0);
    // The width is the door's; it reaches into both rooms, by some centimetres.
    const double depth = std::abs(signedArea(corners)) / width;
    EXPECT_GT(depth, wall + 0.02);
    EXPECT_LT(depth, wall + 0.08);
  }
}

TEST(DoorPassages, LeadNowhereWithoutARoomOnBothSides) {
  const std::vector<RawPolygon> rooms = {room(rectangle(0, 0, 4, 4)),
                                         room(rectangle(4.2, 0, 8, 4))};
  const auto count = [&](const Polyline& door) { return doorPassages(rooms, {door}).size(); };
  EXPECT_EQ(count({{4.1, 1}, {4.1, 2}}), 1U);
  EXPECT_EQ(count({{4.0, 1}, {4.0, 2}}), 1U);            // along a face of the wall
  EXPECT_EQ(count({{4.1, 1}, {4.1, 2}, {4.1, 3}}), 2U);  // a double door
  EXPECT_EQ(count({{0, 1}, {0, 2}}), 0U);                // to the outside
  EXPECT_EQ(count({{2, 1}, {2, 2}}), 0U);                // within a room
  EXPECT_EQ(count({{4.1, 3.5}, {4.1, 4.5}}), 0U);        // half of it beyond the rooms
  EXPECT_EQ(count({{4.1, 1}, {4.1, 1}}), 0U);
  EXPECT_EQ(count({{4.1, 1}}), 0U);
}

TEST(DoorPassages, ThickWallsStay) {
  for (const double wall : {0.49, 0.55}) {
    const std::vector<RawPolygon> rooms = {room(rectangle(0, 0, 4, 4)),
                                           room(rectangle(4 + wall, 0, 8, 4))};
    EXPECT_EQ(doorPassages(rooms, {{{4.1, 1}, {4.1, 2}}}).size(),
              wall < kThickestDoorWall ? 1U : 0U);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
