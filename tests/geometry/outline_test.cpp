#include "tests/support/map_factories.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/geometry/outline.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

double distanceTo(const TPoint2D& a, const TPoint2D& b, const TPoint2D& p) {
  const TPoint2D edge = b - a, offset = p - a;
  const double length2 = edge.x * edge.x + edge.y * edge.y;
  double t = length2 > 0.0 ? (edge.x * offset.x + edge.y * offset.y) / length2 : 0.0;
  t = std::min(std::max(t, 0.0), 1.0);
  return std::hypot(offset.x - t * edge.x, offset.y - t * edge.y);
}

double distanceTo(const std::vector<Polyline>& chains, const TPoint2D& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polyline& chain : chains) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      least = std::min(least, distanceTo(chain[i - 1], chain[i], p));
    }
  }
  return least;
}

std::size_t vertexCount(const std::vector<Polyline>& chains) {
  std::size_t count = 0;
  for (const Polyline& chain : chains) count += chain.size();
  return count;
}

/// A ring of many vertices, open over a third of its edges.
PolygonMap wavyRing(int n) {
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n, radius = 10.0 + 0.02 * std::sin(40 * angle);
    ring.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    ring.kinds.push_back(3 * i < n ? EdgeKind::open : EdgeKind::wall);
  }
  return PolygonMap({{ring, {}}});
}

TEST(Outline, OfNoToleranceIsTheMap) {
  const PolygonMap map = pillarMap();
  const MapOutline outline = outlineOf(map, 0.0);
  ASSERT_EQ(outline.free.size(), map.rings().size());
  EXPECT_TRUE(outline.open.empty());
  for (std::size_t i = 0; i < outline.free.size(); ++i) {
    const Polyline& closed = outline.free[i];
    EXPECT_EQ(closed.front(), closed.back());
    EXPECT_EQ(Polyline(closed.begin(), closed.end() - 1), map.rings()[i]->vertices);
  }
}

TEST(Outline, EveryVertexIsWithinTheTolerance) {
  const PolygonMap map = wavyRing(2000);
  std::size_t before = map.vertexCount();
  for (const double tolerance : {0.001, 0.01, 0.05, 0.3}) {
    const MapOutline outline = outlineOf(map, tolerance);
    const Ring& ring = map.components()[0].outer;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto& chains = ring.kinds[i] == EdgeKind::wall ? outline.walls : outline.open;
      EXPECT_LE(distanceTo(chains, ring.vertices[i]), tolerance + 1e-9);
      EXPECT_LE(distanceTo(outline.free, ring.vertices[i]), tolerance + 1e-9);
    }
    const std::size_t count = vertexCount(outline.walls) + vertexCount(outline.open);
    EXPECT_LT(count, before);
    before = count;
  }
  EXPECT_LT(before, 60U);
}

TEST(Outline, KindsStayApartWhereverTheRingBegins) {
  Ring ring{rectangle(0, 0, 4, 3), std::vector<EdgeKind>(4, EdgeKind::wall)};
  for (std::size_t open = 0; open < 4; ++open) {
    ring.kinds.assign(4, EdgeKind::wall);
    ring.kinds[open] = EdgeKind::open;
    const MapOutline outline = outlineOf(PolygonMap({{ring, {}}}), 0.1);
    ASSERT_EQ(outline.open.size(), 1U);
    EXPECT_EQ(outline.open[0], (Polyline{ring.vertices[open], ring.vertices[(open + 1) % 4]}));
    ASSERT_EQ(outline.walls.size(), 1U);
    EXPECT_EQ(outline.walls[0].size(), 4U);
    EXPECT_EQ(outline.free[0].size(), 5U);
  }
}

TEST(Outline, LeavesOutWhatIsSmall) {
  const PolygonMap map = pillarMap();
  EXPECT_EQ(outlineOf(map, 0.9).free.size(), map.rings().size());
  EXPECT_EQ(outlineOf(map, 1.1).free.size(), 1U);  // pillars of 1 m
  EXPECT_TRUE(outlineOf(map, 1e3).free.empty());
  const PolygonMap beyond({freePolygon(rectangle(0, 0, 4, 3))}, {{{5, 0}, {5, 0.1}}});
  EXPECT_EQ(outlineOf(beyond, 0.05).beyond.size(), 1U);
  EXPECT_TRUE(outlineOf(beyond, 0.2).beyond.empty());
}

TEST(Outline, RefusesABadTolerance) {
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(outlineOf(squareMap(), bad), InvalidParamsError);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
