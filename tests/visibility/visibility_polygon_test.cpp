#include "tests/support/cgal_visibility.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

using test::CgalVisibility;
using test::floorPlan;
using test::FloorPlanParams;

double distance(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D e = b - a, d = p - a;
  const double squared = e.x * e.x + e.y * e.y;
  const double s = squared > 0 ? std::clamp((d.x * e.x + d.y * e.y) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(d.x - s * e.x, d.y - s * e.y);
}

/// The greatest distance of a vertex of `from` to the border of `to`.
double deviation(const std::vector<TPoint2D>& from, const std::vector<TPoint2D>& to) {
  double greatest = 0.0;
  for (const TPoint2D& p : from) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < to.size(); ++i) {
      least = std::min(least, distance(p, to[i], to[(i + 1) % to.size()]));
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

/// Compares the polygon seen from a point (moved by the expander if it was on a border) with
/// CGAL's; returns whether there was something to compare.
bool compare(ViewExpander& expander, const CgalVisibility& oracle, const TPoint2D& point,
             double tolerance) {
  const View& view = expander.expand(point);
  const auto expected = oracle.polygon(view.viewpoint);
  if (!expected) return false;
  const std::vector<TPoint2D> polygon = visibilityPolygon(expander.triangulation(), view);
  SCOPED_TRACE("from " + std::to_string(point.x) + " " + std::to_string(point.y));
  EXPECT_NEAR(signedArea(polygon), signedArea(*expected),
              tolerance * (1.0 + signedArea(*expected)));
  EXPECT_LT(deviation(polygon, *expected), tolerance);
  EXPECT_LT(deviation(*expected, polygon), tolerance);
  return true;
}

/// Points on a map's lattice of vertex coordinates, on its vertices and on its edges: in line with
/// as much as possible.
std::vector<TPoint2D> degeneratePoints(const PolygonMap& map, std::size_t count,
                                       std::mt19937& random) {
  std::vector<TPoint2D> vertices, points;
  for (const Ring* ring : map.rings()) {
    vertices.insert(vertices.end(), ring->vertices.begin(), ring->vertices.end());
  }
  const auto any = [&] { return vertices[random() % vertices.size()]; };
  while (points.size() < count) {
    const TPoint2D a = any(), b = any();
    points.insert(points.end(), {TPoint2D(a.x, b.y), a, (a + b) * 0.5, a * 2 - b});
    const Ring& ring = *map.rings()[random() % map.rings().size()];
    const std::size_t i = random() % ring.size();
    points.push_back((ring.vertices[i] + ring.vertices[(i + 1) % ring.size()]) * 0.5);
  }
  return points;
}

TEST(VisibilityPolygon, EqualsCgalOnRandomMaps) {
  std::mt19937 random(31);
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FloorPlanParams params = test::randomParams(random);
    params.unknown_share = 0.0;
    params.crossing_walls = 0;
    const PolygonMap map = floorPlan(params, seed);
    const Triangulation triangulation(map);
    ViewExpander expander(triangulation);
    const CgalVisibility oracle(test::borders(map));
    for (const TPoint2D& p : test::randomFreePoints(map, 40, random)) {
      EXPECT_TRUE(compare(expander, oracle, p, 1e-7));
    }
  }
}

TEST(VisibilityPolygon, SeesThroughOpenEdgesOrEndsThere) {
  std::mt19937 random(32);
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FloorPlanParams params = test::randomParams(random);
    params.unknown_share = 0.8;
    params.crossing_walls = 0;
    const PolygonMap map = floorPlan(params, seed);
    const Triangulation triangulation(map);
    ViewExpander through(triangulation), until(triangulation, true);
    const CgalVisibility beyond(test::wallsAndBox(map, triangulation.box()));
    const CgalVisibility within(test::borders(map));
    for (const TPoint2D& p : test::randomFreePoints(map, 25, random)) {
      EXPECT_TRUE(compare(through, beyond, p, 1e-7));
      EXPECT_TRUE(compare(until, within, p, 1e-7));
    }
    for (const TPoint2D& p : test::randomPoints(map, 0.9, 25, random)) {
      EXPECT_TRUE(compare(through, beyond, p, 1e-7));
    }
  }
}

TEST(VisibilityPolygon, EqualsCgalInLineWithManyVertices) {
  std::mt19937 random(33);
  std::size_t compared = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FloorPlanParams params = test::randomParams(random);
    params.rotation = 0.0;
    params.offset = {0, 0};
    params.jitter = 0.0;
    params.edge_length = seed % 2 == 0 ? 0.0 : 0.5;  // many vertices along one line
    const PolygonMap map = floorPlan(params, seed);
    const Triangulation triangulation(map);
    ViewExpander expander(triangulation);
    const CgalVisibility oracle(test::wallsAndBox(map, triangulation.box()));
    for (const TPoint2D& p : degeneratePoints(map, 60, random)) {
      compared += compare(expander, oracle, p, 1e-6) ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 300U);
}

TEST(VisibilityPolygon, EqualsCgalFarFromTheOrigin) {
  std::mt19937 random(34);
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    FloorPlanParams params = test::randomParams(random);
    params.unknown_share = 0.0;
    params.crossing_walls = 0;
    params.offset = {1e6, -1e6};
    const PolygonMap map = floorPlan(params, seed);
    const Triangulation triangulation(map);
    ViewExpander expander(triangulation);
    const CgalVisibility oracle(test::borders(map));
    for (const TPoint2D& p : test::randomFreePoints(map, 30, random)) {
      EXPECT_TRUE(compare(expander, oracle, p, 1e-4));
    }
  }
}

TEST(VisibilityPolygon, TakesHolesThatTouch) {
  const PolygonMap map(
      {{wallRing({{0, 0}, {10, 0}, {10, 10}, {0, 10}}),
        {wallRing({{2, 2}, {2, 4}, {4, 4}, {4, 2}}), wallRing({{4, 4}, {4, 6}, {6, 6}, {6, 4}}),
         wallRing({{6, 4}, {6, 5}, {8, 5}, {8, 4}}), wallRing({{0, 8}, {1, 9}, {1, 7}})}}});
  std::mt19937 random(35);
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation);
  const CgalVisibility oracle(test::borders(map));
  for (const TPoint2D& p : test::randomFreePoints(map, 200, random)) {
    EXPECT_TRUE(compare(expander, oracle, p, 1e-7));
  }
  for (const TPoint2D& p : degeneratePoints(map, 200, random)) {
    if (map.contains(p)) compare(expander, oracle, p, 1e-6);
  }
}

TEST(VisibilityPolygon, TakesSlivers) {
  const PolygonMap map({{wallRing({{0, 0}, {10, 0}, {10, 10}, {0, 10}}),
                         {wallRing({{7, 1}, {7, 1 + 1e-9}, {9, 1}}),
                          wallRing({{8, 8}, {8 + 1e-7, 9}, {8 + 1e-7, 8}}),
                          wallRing({{2, 2}, {2, 2.5}, {2 + 1e-12, 2}})}}});
  std::mt19937 random(36);
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation);
  const CgalVisibility oracle(test::borders(map));
  for (const TPoint2D& p : test::randomFreePoints(map, 200, random)) {
    EXPECT_TRUE(compare(expander, oracle, p, 1e-7));
  }
}

TEST(VisibilityPolygon, IsTheRoomWhereTheRoomIsConvex) {
  const std::vector<TPoint2D> room{{0, 0}, {4, 0}, {5, 2}, {3, 4}, {0, 3}};
  const Triangulation triangulation(PolygonMap({{wallRing(room), {}}}));
  ViewExpander expander(triangulation);
  const std::vector<TPoint2D> polygon = visibilityPolygon(triangulation, expander.expand({1, 1}));
  ASSERT_EQ(polygon.size(), room.size());
  EXPECT_TRUE(std::is_permutation(polygon.begin(), polygon.end(), room.begin()));
  EXPECT_DOUBLE_EQ(signedArea(polygon), signedArea(room));
}

TEST(VisibilityPolygon, IsEmptyOutsideTheBox) {
  const Triangulation triangulation(PolygonMap({{wallRing({{0, 0}, {4, 0}, {0, 3}}), {}}}));
  ViewExpander expander(triangulation);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(visibilityPolygon(triangulation, expander.expand({100, 0})).empty());
  EXPECT_TRUE(visibilityPolygon(triangulation, expander.expand({nan, 1})).empty());
}

}  // namespace
}  // namespace mrpt_polyloc
