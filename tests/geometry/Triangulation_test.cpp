#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

using test::floorPlan;
using test::FloorPlanParams;
using Face = Triangulation::Face;

const TPoint2D& at(const Triangulation& t, std::int32_t vertex) {
  return t.vertices()[static_cast<std::size_t>(vertex)];
}

double area(const Triangulation& t, const Face& face) {
  const TPoint2D &a = at(t, face.vertex[0]), &b = at(t, face.vertex[1]), &c = at(t, face.vertex[2]);
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

double area(const Triangulation& t, bool is_free) {
  double sum = 0.0;
  for (const Face& face : t.faces()) sum += face.is_free == is_free ? area(t, face) : 0.0;
  return sum;
}

/// The length of all edges of a kind, those between two free faces counted apart.
double length(const Triangulation& t, Passage passage) {
  double sum = 0.0;
  for (const Face& face : t.faces()) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.passage[i] != passage) continue;
      sum += 0.5 * (at(t, face.vertex[(i + 1) % 3]) - at(t, face.vertex[(i + 2) % 3])).norm();
    }
  }
  return sum;
}

/// In the closed triangle, up to rounding of long double.
bool holds(const Triangulation& t, const Face& face, const TPoint2D& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const TPoint2D &a = at(t, face.vertex[i]), &b = at(t, face.vertex[(i + 1) % 3]);
    const long double turn = (static_cast<long double>(b.x) - a.x) * (p.y - a.y) -
                             (static_cast<long double>(b.y) - a.y) * (p.x - a.x);
    if (turn < -1e-9L) return false;
  }
  return true;
}

void expectConsistent(const Triangulation& t) {
  const double box = (t.box().max.x - t.box().min.x) * (t.box().max.y - t.box().min.y);
  EXPECT_NEAR(area(t, true) + area(t, false), box, 1e-9 * box);
  for (std::size_t f = 0; f < t.faces().size(); ++f) {
    const Face& face = t.faces()[f];
    EXPECT_GE(area(t, face), -1e-12);
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.neighbor[i] == Triangulation::kNone) continue;
      const Face& other = t.faces()[static_cast<std::size_t>(face.neighbor[i])];
      std::size_t back = 0;
      while (back < 3 && other.neighbor[back] != static_cast<std::int32_t>(f)) ++back;
      ASSERT_LT(back, 3U) << "face " << f << " is not a neighbour of its neighbour";
      EXPECT_EQ(other.vertex[(back + 1) % 3], face.vertex[(i + 2) % 3]);
      EXPECT_EQ(other.vertex[(back + 2) % 3], face.vertex[(i + 1) % 3]);
      EXPECT_EQ(other.passage[back], face.passage[i]);
      if (face.passage[i] == Passage::clear) {
        EXPECT_EQ(face.is_free, other.is_free);
      }
    }
  }
}

std::vector<TPoint2D> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<TPoint2D> reversed(std::vector<TPoint2D> ring) {
  return {ring.rbegin(), ring.rend()};
}

TEST(Triangulation, FillsRandomMaps) {
  std::mt19937 random(11);
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FloorPlanParams params = test::randomParams(random);
    const bool crossed = params.crossing_walls > 0;
    const PolygonMap map = floorPlan(params, seed);
    const Triangulation t(map);
    expectConsistent(t);
    EXPECT_NEAR(area(t, true), map.area(), 1e-7 * map.area());
    EXPECT_NEAR(length(t, Passage::open), map.openPerimeter(), 1e-6);
    const double walls = map.perimeter() - map.openPerimeter() + map.wallsBeyondLength();
    // Where walls beyond lie on one another or on walls (windows do), they count once.
    EXPECT_LT(length(t, Passage::wall), walls + 1e-6);
    if (!crossed && params.unknown_share == 0.0) {
      EXPECT_NEAR(length(t, Passage::wall), walls, 1e-6);
    }
  }
}

TEST(Triangulation, LocatesAnyPoint) {
  std::mt19937 random(12);
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = floorPlan(test::randomParams(random), seed);
    const Triangulation t(map);
    std::vector<TPoint2D> points = test::randomPoints(map, 0.99, 1000, random);
    for (const Ring* ring : map.rings()) {
      for (std::size_t i = 0; i < ring->size(); ++i) {
        const TPoint2D &a = ring->vertices[i], &b = ring->vertices[(i + 1) % ring->size()];
        points.insert(points.end(), {a, (a + b) * 0.5});
      }
    }
    const BoundingBox& box = t.box();
    points.insert(points.end(), {box.min, box.max, {box.min.x, 0.5 * (box.min.y + box.max.y)}});
    for (const TPoint2D& p : points) {
      const int face = t.locate(p);
      ASSERT_NE(face, Triangulation::kNone) << p.x << " " << p.y;
      EXPECT_TRUE(holds(t, t.faces()[static_cast<std::size_t>(face)], p)) << p.x << " " << p.y;
    }
  }
}

TEST(Triangulation, KnowsFreePointsAsTheMapDoes) {
  std::mt19937 random(13);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const PolygonMap map = floorPlan(test::randomParams(random), seed);
    const Triangulation t(map);
    for (const TPoint2D& p : test::randomPoints(map, 0.5, 1000, random)) {
      EXPECT_EQ(t.isFree(p), map.contains(p)) << "seed " << seed << " at " << p.x << " " << p.y;
    }
  }
}

TEST(Triangulation, HasNoFaceOutsideTheBox) {
  const Triangulation t(PolygonMap({{wallRing(rectangle(0, 0, 4, 3)), {}}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const TPoint2D& p : {TPoint2D(-1.001, 1), TPoint2D(2, 4.001), TPoint2D(1e300, 0),
                            TPoint2D(nan, 1), TPoint2D(1, nan), TPoint2D(-infinity, infinity)}) {
    EXPECT_EQ(t.locate(p), Triangulation::kNone);
    EXPECT_FALSE(t.isFree(p));
  }
  EXPECT_EQ(t.box().min.x, -1.0);
  EXPECT_EQ(t.box().max.y, 4.0);
}

TEST(Triangulation, KeepsAComponentInsideAHole) {
  const PolygonMap map(
      {{wallRing(rectangle(0, 0, 10, 10)), {wallRing(reversed(rectangle(2, 2, 8, 8)))}},
       {wallRing(rectangle(3, 3, 7, 7)), {}},
       {wallRing(rectangle(20, 0, 21, 1)), {}}});
  const Triangulation t(map);
  expectConsistent(t);
  EXPECT_NEAR(area(t, true), 100 - 36 + 16 + 1, 1e-9);
  EXPECT_TRUE(t.isFree({1, 5}));
  EXPECT_FALSE(t.isFree({2.5, 5}));
  EXPECT_TRUE(t.isFree({5, 5}));
  EXPECT_FALSE(t.isFree({15, 0.5}));
  EXPECT_TRUE(t.isFree({20.5, 0.5}));
}

TEST(Triangulation, CutsWallsBeyondThatCross) {
  const PolygonMap map({{wallRing(rectangle(0, 0, 4, 4)), {}}},
                       {{{-2, 1}, {6, 3}}, {{-2, 3}, {6, 1}}, {{2, -2}, {2, 6}}});
  const Triangulation t(map);
  expectConsistent(t);
  EXPECT_NEAR(area(t, true), 16.0, 1e-9);
  EXPECT_NEAR(length(t, Passage::wall), 16 + 2 * std::sqrt(68.0) + 8, 1e-9);
}

TEST(Triangulation, TakesTheWallWhereWallAndOpenEdgeOverlap) {
  Ring left = wallRing(rectangle(0, 0, 4, 4));
  left.kinds[1] = EdgeKind::open;  // x = 4, from y = 0 to 4
  const PolygonMap map({{left, {}}}, {{{4, 1}, {4, 2}}, {{4, 1.5}, {4, 3}}, {{4, 3}, {4, 3}}});
  const Triangulation t(map);
  expectConsistent(t);
  EXPECT_NEAR(length(t, Passage::open), 2.0, 1e-9);   // y in [0, 1] and [3, 4]
  EXPECT_NEAR(length(t, Passage::wall), 14.0, 1e-9);  // three sides and y in [1, 3]
}

TEST(Triangulation, TakesBordersThatTouchAndRepeat) {
  // Two holes that share an edge, one that touches the outer ring in a vertex, one in a T.
  const PolygonMap map(
      {{wallRing(rectangle(0, 0, 10, 10)),
        {wallRing(reversed(rectangle(2, 2, 4, 4))), wallRing(reversed(rectangle(4, 2, 6, 4))),
         wallRing({{0, 6}, {1, 7}, {1, 5}}), wallRing({{7, 4}, {8, 3}, {6, 3}})}}});
  const Triangulation t(map);
  expectConsistent(t);
  EXPECT_NEAR(area(t, true), 100 - 4 - 4 - 1 - 1, 1e-9);
  EXPECT_FALSE(t.isFree({3, 3}));
  EXPECT_FALSE(t.isFree({5, 3}));
  EXPECT_FALSE(t.isFree({0.7, 6}));
}

TEST(Triangulation, TakesNearlyOverlappingConstraintsFarFromTheOrigin) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 200; ++round) {
    // A bundle of walls along one line, off it by some last places of their coordinates.
    const TPoint2D a(1e6 + 5 * uniform(random), 1e6 + 5 * uniform(random));
    const TPoint2D u(uniform(random), uniform(random));
    std::vector<Polyline> walls;
    for (int i = 0; i < 12; ++i) {
      const double s = 3 * uniform(random), e = 3 * uniform(random);
      const auto noise = [&] { return 2e-10 * uniform(random); };
      walls.push_back({{a.x + s * u.x + noise(), a.y + s * u.y + noise()},
                       {a.x + e * u.x + noise(), a.y + e * u.y + noise()}});
    }
    const PolygonMap map({{wallRing(rectangle(1e6 - 10, 1e6 - 10, 1e6 + 10, 1e6 + 10)), {}}},
                         walls);
    SCOPED_TRACE("round " + std::to_string(round));
    const Triangulation t(map);
    EXPECT_NEAR(area(t, true), 400.0, 1e-5);
    for (const Polyline& wall : walls) {
      const TPoint2D middle = (wall[0] + wall[1]) * 0.5;
      EXPECT_NE(t.locate(middle), Triangulation::kNone);
    }
  }
}

TEST(Triangulation, TakesSlivers) {
  const PolygonMap map({{wallRing({{0, 0}, {100, 0}, {100, 1e-9}}), {}},
                        {wallRing({{0, 1}, {1e-12, 1}, {0, 3}}), {}}});
  const Triangulation t(map);
  expectConsistent(t);
  EXPECT_NEAR(area(t, true), map.area(), 1e-12);
}

TEST(Triangulation, LocatesInALargeNoisyMap) {
  std::mt19937 random(15);
  FloorPlanParams params = test::noisyFloor();
  params.edge_length = 0.1;
  const PolygonMap map = floorPlan(params, 15);
  ASSERT_GT(map.vertexCount(), 10000U);
  const Triangulation t(map);
  EXPECT_NEAR(area(t, true), map.area(), 1e-7 * map.area());
  for (const TPoint2D& p : test::randomPoints(map, 0.9, 3000, random)) {
    const int face = t.locate(p);
    ASSERT_NE(face, Triangulation::kNone);
    EXPECT_TRUE(holds(t, t.faces()[static_cast<std::size_t>(face)], p));
  }
}

TEST(Triangulation, BesideFreeSpaceIsWhatNoWallCutsOff) {
  // A room of 4 x 4 m, open on its right side.
  Ring ring = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  ring.kinds[1] = EdgeKind::open;
  const Triangulation t(PolygonMap({{ring, {}}}));
  EXPECT_TRUE(t.isFreeOrBeside({2, 2}, 0.5));
  EXPECT_TRUE(t.isFreeOrBeside({4.4, 2}, 0.5));
  EXPECT_FALSE(t.isFreeOrBeside({4.6, 2}, 0.5));
  EXPECT_FALSE(t.isFreeOrBeside({-0.1, 2}, 0.5));  // behind a wall
  EXPECT_FALSE(t.isFreeOrBeside({3.5, -0.1}, 0.5));
  EXPECT_TRUE(t.isFreeOrBeside({4.2, 4.1}, 0.5));  // around the wall's end
  EXPECT_FALSE(t.isFreeOrBeside({100, 2}, 0.5));   // outside the box
}

TEST(Triangulation, BesideFreeSpaceAgreesWithDenseSampling) {
  std::mt19937 random(16);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  FloorPlanParams params;
  params.unknown_share = 0.5;
  params.rooms_per_side = 2;
  const PolygonMap map = floorPlan(params, 16);
  const Triangulation t(map);
  constexpr double kDistance = 0.4;
  int beside = 0, other = 0;
  for (const TPoint2D& p : test::randomPoints(map, 0.9, 2000, random)) {
    if (t.isFree(p)) continue;
    // Straight ways into free space that stay off every wall are a part of all ways.
    bool is_seen = false;
    for (int k = 0; k < 400; ++k) {
      const TPoint2D q{p.x + kDistance * unit(random), p.y + kDistance * unit(random)};
      if ((q - p).norm() > kDistance || !t.isFree(q)) continue;
      bool is_blocked = false;
      for (const Ring* ring : map.rings()) {
        for (std::size_t i = 0; i < ring->size(); ++i) {
          if (ring->kinds[i] != EdgeKind::wall) continue;
          const TPoint2D &a = ring->vertices[i], &b = ring->vertices[(i + 1) % ring->size()];
          is_blocked |= test::segmentsCross(p, q, a, b);
        }
      }
      for (const Polyline& wall : map.wallsBeyond()) {
        for (std::size_t i = 1; i < wall.size(); ++i) {
          is_blocked |= test::segmentsCross(p, q, wall[i - 1], wall[i]);
        }
      }
      is_seen |= !is_blocked;
    }
    const bool found = t.isFreeOrBeside(p, kDistance);
    EXPECT_TRUE(found || !is_seen) << p.x << " " << p.y;
    EXPECT_TRUE(!found || t.isFreeOrBeside(p, kDistance + 1.0));
    ++(found ? beside : other);
  }
  EXPECT_GT(beside, 20);
  EXPECT_GT(other, 100);
}

}  // namespace
}  // namespace mrpt_polyloc
