#include "exact_views.h"
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using testing::HasSubstr;

/// Distance of a point from a segment [m].
double distanceTo(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D d = b - a;
  const double t =
      std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / (d.x * d.x + d.y * d.y), 0.0, 1.0);
  return std::hypot(a.x + t * d.x - p.x, a.y + t * d.y - p.y);
}

/// Whether all of a wall lies on edges of the map: on one, or on several in line.
bool isOnEdges(const PolygonMap& map, const TPoint2D& from, const TPoint2D& to) {
  for (int k = 0; k <= 8; ++k) {
    const TPoint2D p = from + (to - from) * (k / 8.0);
    bool is_on_one = false;
    for (const Ring* ring : map.rings()) {
      for (std::size_t i = 0; i < ring->size(); ++i) {
        is_on_one = is_on_one ||
                    distanceTo(p, ring->vertices[i], ring->vertices[(i + 1) % ring->size()]) < 1e-5;
      }
    }
    if (!is_on_one) return false;
  }
  return true;
}

bool isVertex(const PolygonMap& map, const TPoint2D& p) {
  for (const Ring* ring : map.rings()) {
    for (const TPoint2D& v : ring->vertices) {
      if (std::hypot(v.x - p.x, v.y - p.y) < 1e-5) return true;
    }
  }
  return false;
}

TEST(ObservedPolygon, ItsWallsAreTheMapsAndItsWindowsAreNot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  std::size_t walls = 0, windows = 0;
  for (const auto& [name, map] : namedMaps()) {
    SCOPED_TRACE(name);
    const BruteForceRays rays(map);
    for (const TPoint2D& p : randomFreePoints(map, 20, random)) {
      const TPose2D pose{p.x, p.y, angle(random)};
      const std::vector<TPoint2D> polygon = seenFrom(map, pose);
      const ObservedPolygon seen(polygon, kExactTolerance);
      const double c = std::cos(pose.phi), s = std::sin(pose.phi);
      const auto inMap = [&](const TPoint2D& q) {
        return TPoint2D(pose.x + c * q.x - s * q.y, pose.y + s * q.x + c * q.y);
      };
      double farthest = 0.0;
      for (const TPoint2D& vertex : polygon) farthest = std::max(farthest, vertex.norm());
      EXPECT_NEAR(seen.radius(), farthest, 1e-5);
      windows += polygon.size() - seen.walls().size();
      for (std::size_t i = 0; i < seen.walls().size(); ++i) {
        const ObservedPolygon::Wall& wall = seen.walls()[i];
        ++walls;
        EXPECT_TRUE(isOnEdges(map, inMap(wall.from), inMap(wall.to)));
        EXPECT_NEAR(wall.normal.norm(), 1.0, 1e-12);
        EXPECT_NEAR(wall.normal.x * wall.from.x + wall.normal.y * wall.from.y, wall.distance, 1e-9);
        EXPECT_GT(wall.distance, 0.0);
        if (seen.beginsAtVertex(i)) {
          EXPECT_TRUE(isVertex(map, inMap(wall.from)));
        }
        if (seen.endsAtVertex(i)) {
          EXPECT_TRUE(isVertex(map, inMap(wall.to)));
        }
        // What is seen in the wall's middle, by a ray.
        const TPoint2D middle = (wall.from + wall.to) * 0.5;
        const RayHit hit = rays.cast(p, std::atan2(middle.y, middle.x) + pose.phi);
        EXPECT_NEAR(std::min(hit.wall, hit.open), middle.norm(), 1e-5);
      }
    }
  }
  EXPECT_GT(walls, 500U);
  EXPECT_GT(windows, 100U);
}

TEST(ObservedPolygon, TellsWindowsFromWallsInASmallCase) {
  // A room of 2 m by 2 m, and on the right a view into a corridor through a door in the ray's way.
  const ObservedPolygon seen(
      {{-1, -1}, {1, -1}, {1, -0.5}, {3, -1.5}, {3, 1.5}, {1, 0.5}, {1, 1}, {-1, 1}},
      kExactTolerance);
  EXPECT_EQ(seen.walls().size(), 6U);  // two of the eight edges are windows
  EXPECT_TRUE(seen.isClear());
  EXPECT_NEAR(seen.radius(), std::hypot(3.0, 1.5), 1e-12);
  std::size_t corridor = 0;
  for (std::size_t i = 0; i < seen.walls().size(); ++i) {
    if (seen.walls()[i].distance < 2.5) continue;
    ++corridor;  // it is cut off by the door's posts: neither end is a vertex of the map
    EXPECT_FALSE(seen.beginsAtVertex(i));
    EXPECT_FALSE(seen.endsAtVertex(i));
  }
  EXPECT_EQ(corridor, 1U);
  // A door's jamb that is nearly in line with the eye leaves doubt.
  EXPECT_FALSE(
      ObservedPolygon(
          {{-1, -1}, {1, -1}, {1, -0.5}, {3, -1.5 + 2e-6}, {3, 1.5}, {1, 0.5}, {1, 1}, {-1, 1}},
          kExactTolerance)
          .isClear());
}

TEST(ObservedPolygon, DropsVerticesThatSayNothing) {
  const ObservedPolygon plain({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, kExactTolerance);
  const ObservedPolygon cut(
      {{-1, -1}, {0, -1}, {0.5, -1}, {1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}, kExactTolerance);
  EXPECT_EQ(cut.walls().size(), plain.walls().size());
  EXPECT_TRUE(agree(plain, cut, 1e-6));
}

TEST(ObservedPolygon, AgreesWithItselfMovedByLessThanTheLimit) {
  std::mt19937 random(2);
  const PolygonMap map = floorPlan(randomParams(random), 3);
  std::size_t apart = 0, tried = 0;
  for (const TPoint2D& p : randomFreePoints(map, 30, random)) {
    const ObservedPolygon here(seenFrom(map, {p.x, p.y, 0}), kExactTolerance);
    const ObservedPolygon turned(seenFrom(map, {p.x, p.y, 1e-8}), kExactTolerance);
    EXPECT_TRUE(agree(here, turned, 1e-5));
    if (!map.contains({p.x + 0.05, p.y})) continue;
    ++tried;
    apart +=
        !agree(here, ObservedPolygon(seenFrom(map, {p.x + 0.05, p.y, 0}), kExactTolerance), 1e-5);
  }
  EXPECT_EQ(apart, tried);
  EXPECT_GT(tried, 10U);
}

TEST(ObservedPolygon, RefusesWhatIsNotSeenFromTheOrigin) {
  const auto complaint = [](const std::vector<TPoint2D>& vertices) {
    return messageOf<InvalidParamsError>([&] { ObservedPolygon(vertices, kExactTolerance); });
  };
  EXPECT_THAT(complaint({{1, 1}, {3, 1}, {3, 3}, {1, 3}}), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(complaint({{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}), HasSubstr("counterclockwise"));
  EXPECT_THAT(complaint({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(complaint({{-1, 0}, {1, 0}, {0, 1}}), HasSubstr("origin lies on the edge"));
  EXPECT_THAT(complaint({{-1, -1}, {1, -1}}), HasSubstr("three are needed"));
  EXPECT_THAT(complaint({{-1, -1}, {1, -1}, {NAN, 1}}), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace mrpt_polyloc::test
