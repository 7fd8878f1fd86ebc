#include "tests/support/map_factories.h"
#include "tests/support/ring_oracles.h"
#include "tests/support/temp_file.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;

/// A random simple ring with integer coordinates, so that int64 arithmetic is exact.
std::vector<TPoint2D> integerRing(std::size_t n, unsigned seed) {
  std::vector<TPoint2D> ring = randomSimpleRing(n, seed, 1e6);
  for (TPoint2D& p : ring) p = {std::round(p.x), std::round(p.y)};
  return ring;
}

std::int64_t exactCross(const TPoint2D& o, const TPoint2D& a, const TPoint2D& b) {
  const auto integer = [](double v) { return static_cast<std::int64_t>(v); };
  return integer(a.x - o.x) * integer(b.y - o.y) - integer(a.y - o.y) * integer(b.x - o.x);
}

TEST(PolygonMap, AreaAndReflexCountAgreeWithIntegerArithmetic) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonMap map = mapOf(integerRing(40, seed));
    const std::vector<TPoint2D>& v = map.components()[0].outer.vertices;
    std::int64_t twice_area = 0;
    std::size_t reflex = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const TPoint2D& next = v[(i + 1) % v.size()];
      twice_area += exactCross({0, 0}, v[i], next);
      reflex += exactCross(v[(i + v.size() - 1) % v.size()], v[i], next) < 0;
    }
    EXPECT_DOUBLE_EQ(map.area(), 0.5 * static_cast<double>(twice_area));
    EXPECT_EQ(map.reflexVertexCount(), reflex);
  }
}

TEST(PolygonMap, AreaAndPerimeterOfKnownShapes) {
  EXPECT_DOUBLE_EQ(lRoomMap().area(), 12.0);
  EXPECT_DOUBLE_EQ(lRoomMap().perimeter(), 16.0);
  EXPECT_EQ(lRoomMap().reflexVertexCount(), 1U);
  const PolygonMap pillars = pillarMap(3, 2);
  EXPECT_DOUBLE_EQ(pillars.area(), 11.0 * 8.0 - 6.0);
  EXPECT_DOUBLE_EQ(pillars.perimeter(), 2 * (11.0 + 8.0) + 6 * 4.0);
  EXPECT_EQ(pillars.holeCount(), 6U);
  EXPECT_EQ(pillars.vertexCount(), 28U);
  EXPECT_EQ(pillars.reflexVertexCount(), 24U);  // every corner of a pillar
  EXPECT_NEAR(translated(pillars, 1e6, -2e6).area(), 82.0, 1e-6);
}

TEST(PolygonMap, ContainsAgreesWithWindingNumbers) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const PolygonMap map = randomMapWithHoles(50, 6, seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1.0, 11.0);
    for (int i = 0; i < 500; ++i) {
      const TPoint2D p(coordinate(random), coordinate(random));
      int winding = 0;  // outer rings count +1, holes -1
      for (const Ring* ring : map.rings()) winding += windingNumber(ring->vertices, p);
      ASSERT_TRUE(winding == 0 || winding == 1);
      EXPECT_EQ(map.contains(p), winding == 1) << p.x << " " << p.y;
    }
  }
}

TEST(PolygonMap, ContainsItsBorder) {
  const PolygonMap map = touchingHolesMap();
  for (const OracleEdge& edge : edgesOf(map)) {
    EXPECT_TRUE(map.contains(edge.a));
    EXPECT_TRUE(map.contains({0.5 * (edge.a.x + edge.b.x), 0.5 * (edge.a.y + edge.b.y)}));
  }
  EXPECT_FALSE(map.contains({5, 5}));     // in a hole
  EXPECT_FALSE(map.contains({12.5, 0}));  // beyond the end of an edge
  EXPECT_FALSE(map.contains({std::nan(""), 1}));
}

TEST(PolygonMap, ContainsPointsAtTheHeightOfVertices) {
  const PolygonMap map = combMap();  // many vertices share their y
  EXPECT_TRUE(map.contains({0.5, 1}));
  EXPECT_FALSE(map.contains({-0.1, 1}));
  EXPECT_FALSE(map.contains({-1, 6}));
  EXPECT_FALSE(map.contains({20, 6}));
  EXPECT_TRUE(map.contains({0.5, 6}));
  EXPECT_FALSE(map.contains({0.9, 6}));
}

TEST(PolygonMap, CountsOpenEdgesAndWallsBeyond) {
  Ring ring = wallRing(rectangle(0, 0, 3, 2));
  ring.kinds[1] = EdgeKind::open;  // the right side
  const PolygonMap map({{ring, {}}}, {{{5, 0}, {5, 2}, {7, 2}}});
  EXPECT_DOUBLE_EQ(map.openPerimeter(), 2.0);
  EXPECT_DOUBLE_EQ(map.wallsBeyondLength(), 4.0);
  EXPECT_DOUBLE_EQ(map.boundingBox().max.x, 7.0);
  EXPECT_DOUBLE_EQ(map.boundingBox().min.x, 0.0);
}

TEST(PolygonMap, HashTellsMapsApart) {
  const PolygonMap map = pillarMap();
  std::set<std::uint64_t> hashes{map.hash()};
  std::size_t count = 1;
  const auto add = [&](const PolygonMap& other) {
    hashes.insert(other.hash());
    EXPECT_EQ(hashes.size(), ++count);
  };
  for (std::size_t ring = 0; ring < map.holeCount(); ++ring) {
    for (std::size_t i = 0; i < 4; ++i) {
      std::vector<FreePolygon> components = map.components();
      components[0].holes[ring].vertices[i].x += 1e-9;
      add(PolygonMap(components));
      components = map.components();
      components[0].holes[ring].kinds[i] = EdgeKind::open;
      add(PolygonMap(components));
    }
  }
  add(PolygonMap(map.components(), {{{0, 0}, {1, 1}}}));
  add(PolygonMap(map.components(), {{{0, 0}, {1, 1}, {2, 2}}}));
  add(PolygonMap(map.components(), {{{0, 0}, {1, 1}}, {{1, 1}, {2, 2}}}));
  std::vector<FreePolygon> fewer = map.components();
  fewer[0].holes.pop_back();
  add(PolygonMap(fewer));
  EXPECT_EQ(pillarMap().hash(), map.hash());
}

TEST(PolygonMap, HashTakesMinusZeroForZero) {
  EXPECT_EQ(mapOf({{0.0, 0.0}, {1, 0}, {0.0, 1}}).hash(),
            mapOf({{-0.0, 0.0}, {1, -0.0}, {-0.0, 1}}).hash());
}

TEST(PolygonMap, RefusesWhatIsNoMap) {
  const auto refusal = [](std::vector<FreePolygon> components, std::vector<Polyline> walls = {}) {
    return messageOf<InvalidMapError>([&] { PolygonMap(components, walls); });
  };
  const Ring square = wallRing(rectangle(0, 0, 1, 1));
  const double nan = std::nan("");
  EXPECT_THAT(refusal({}), HasSubstr("no free space"));
  EXPECT_THAT(refusal({{Ring{}, {}}}), HasSubstr("outer ring with fewer than three vertices"));
  EXPECT_THAT(refusal({{wallRing({{2, 3}, {1, 0}}), {}}}),
              HasSubstr("fewer than three vertices at (2.000, 3.000)"));
  EXPECT_THAT(refusal({{wallRing({{0, 0}, {1, 0}, {1, nan}}), {}}}), HasSubstr("not finite"));
  EXPECT_THAT(refusal({{wallRing({{0, 0}, {1, 1}, {2, 2}}), {}}}), HasSubstr("zero area"));
  EXPECT_THAT(refusal({{wallRing({{0, 0}, {0, 1}, {1, 0}}), {}}}), HasSubstr("orientation"));
  EXPECT_THAT(refusal({{square, {square}}}), HasSubstr("hole of zero area or wrong orientation"));
  EXPECT_THAT(refusal({{Ring{square.vertices, {}}, {}}}), HasSubstr("edge kinds"));
  EXPECT_THAT(refusal({{square, {}}}, {{{1, 1}}}), HasSubstr("wall beyond"));
  EXPECT_THAT(refusal({{square, {}}}, {{{1, 1}, {nan, 0}}}), HasSubstr("wall beyond"));
  EXPECT_THAT(refusal({{wallRing(rectangle(-1e308, -1e308, 1e308, 1e308)), {}}}),
              HasSubstr("too large"));
  EXPECT_EQ(refusal({{square, {}}}), "");
}

}  // namespace
}  // namespace mrpt_polyloc::test
