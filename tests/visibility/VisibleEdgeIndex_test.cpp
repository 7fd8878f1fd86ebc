#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>

namespace mrpt_polyloc {
namespace {

/// An edge by its fixed-point coordinates.
using Edge = std::array<std::int32_t, 4>;

std::set<Edge> edgesOf(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs) {
  std::set<Edge> edges;
  for (const BoundaryChains::Run& run : runs) {
    for (std::uint32_t i = run.first; i < run.first + run.edges; ++i) {
      edges.insert({chains.x()[i], chains.y()[i], chains.x()[i + 1], chains.y()[i + 1]});
    }
  }
  return edges;
}

/// How many of some seen pieces are not listed.
std::size_t missing(const Triangulation& t, const BoundaryChains& chains,
                    const std::vector<VisibleEdge>& pieces, const std::set<Edge>& listed) {
  std::size_t count = 0;
  for (const VisibleEdge& piece : pieces) {
    const TPoint2D& a = t.vertices()[static_cast<std::size_t>(piece.right)];
    const TPoint2D& b = t.vertices()[static_cast<std::size_t>(piece.left)];
    count += listed.count({chains.fixedX(a.x), chains.fixedY(a.y), chains.fixedX(b.x),
                           chains.fixedY(b.y)}) == 0;
  }
  return count;
}

std::vector<VisibleEdge> wallsOf(const View& view) {
  std::vector<VisibleEdge> walls;
  for (const VisibleEdge& piece : view.ends) {
    if (piece.is_wall) walls.push_back(piece);
  }
  return walls;
}

TEST(VisibleEdgeIndex, ListsAllThatIsSeenFromAnyPointOfACell) {
  std::mt19937 random(71);
  std::size_t points = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const PolygonMap map = test::floorPlan(test::randomParams(random), seed);
    const Triangulation t(map);
    const double square_size = seed % 3 == 0 ? 0.2 : seed % 3 == 1 ? 0.5 : 1.7;
    const VisibleEdgeIndex index(t, square_size, 1);
    ViewExpander expander(t);
    for (const TPoint2D& p : test::randomPoints(map, 0.5, 300, random)) {
      if (!t.isFree(p)) continue;  // sees less, see SquareExpander
      const std::int64_t number = index.squareNumber(p);
      ASSERT_GE(number, 0);
      ++points;
      const VisibleEdgeIndex::EdgeRuns square = index.edgeRuns(number);
      const View& view = expander.expand(p);
      EXPECT_EQ(missing(t, index.chains(), wallsOf(view), edgesOf(index.chains(), square.walls)),
                0U)
          << p.x << " " << p.y;
      EXPECT_EQ(missing(t, index.chains(), view.open, edgesOf(index.chains(), square.open)), 0U)
          << p.x << " " << p.y;
    }
  }
  EXPECT_GT(points, 3000U);
}

TEST(VisibleEdgeIndex, ListsNoWallsFarBehindOpenEdges) {
  // Two rooms that look at each other over 30 m of unknown space.
  Ring left = wallRing({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), right = left;
  for (TPoint2D& p : right.vertices) p.x += 34;
  left.kinds[1] = right.kinds[3] = EdgeKind::open;
  const Triangulation t(PolygonMap({{left, {}}, {right, {}}}));
  const auto walls_seen = [&t](double horizon) {
    const VisibleEdgeIndex index(t, 0.5, 1, horizon);
    const VisibleEdgeIndex::EdgeRuns square = index.edgeRuns(index.squareNumber({2, 2}));
    EXPECT_EQ(edgesOf(index.chains(), square.open).size(), 1U) << horizon;
    return edgesOf(index.chains(), square.walls).size();
  };
  EXPECT_EQ(walls_seen(20.0), 3U);
  EXPECT_GE(walls_seen(40.0), 6U);  // the other room's inside, through its open edge
}

TEST(VisibleEdgeIndex, ListsFewEdgesThatAreNotSeen) {
  // From most squares of a floor of 120 rooms only some rooms are seen: the lists are no excuse.
  const PolygonMap map = test::floorPlan(test::largeFloor(), 1);
  const Triangulation t(map);
  const VisibleEdgeIndex index(t, 0.5, 1);
  std::mt19937 random(72);
  ViewExpander expander(t);
  std::size_t listed = 0, seen = 0;
  for (const TPoint2D& p : test::randomFreePoints(map, 500, random)) {
    const VisibleEdgeIndex::EdgeRuns square = index.edgeRuns(index.squareNumber(p));
    listed += edgesOf(index.chains(), square.walls).size();
    seen += wallsOf(expander.expand(p)).size();
  }
  EXPECT_LT(listed, 3 * seen);
}

TEST(VisibleEdgeIndex, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(73);
  const PolygonMap map = test::floorPlan(test::randomParams(random), 73);
  const Triangulation t(map);
  const VisibleEdgeIndex one(t, 0.3, 1), two(t, 0.3, 2), all(t, 0.3, 0);
  ASSERT_EQ(one.bytes(), two.bytes());
  ASSERT_EQ(one.bytes(), all.bytes());
  const auto same = [](const BoundaryChains::Run& a, const BoundaryChains::Run& b) {
    return a.first == b.first && a.edges == b.edges;
  };
  for (const TPoint2D& p : test::randomPoints(map, 0.5, 1000, random)) {
    const std::int64_t number = one.squareNumber(p);
    ASSERT_EQ(two.squareNumber(p), number);
    if (number < 0) continue;
    const VisibleEdgeIndex::EdgeRuns a = one.edgeRuns(number), b = two.edgeRuns(number),
                                     c = all.edgeRuns(number);
    ASSERT_TRUE(std::equal(a.walls.begin(), a.walls.end(), b.walls.begin(), b.walls.end(), same));
    ASSERT_TRUE(std::equal(a.open.begin(), a.open.end(), b.open.begin(), b.open.end(), same));
    ASSERT_TRUE(std::equal(a.walls.begin(), a.walls.end(), c.walls.begin(), c.walls.end(), same));
  }
}

TEST(VisibleEdgeIndex, CoversNoPointOutsideTheBox) {
  const Triangulation t(PolygonMap({{wallRing({{0, 0}, {4, 0}, {0, 3}}), {}}}));
  const VisibleEdgeIndex index(t, 0.5, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const TPoint2D& p :
       {TPoint2D(-1.5, 1), TPoint2D(1e300, 0), TPoint2D(nan, 1), TPoint2D(1, nan)}) {
    EXPECT_FALSE(index.covers(p));
  }
  EXPECT_TRUE(index.covers({1, 1}));
  EXPECT_TRUE(index.covers({-0.4, 1}));  // next to free space
}

TEST(VisibleEdgeIndex, RefusesCellSizesThatMakeNoGrid) {
  const Triangulation t(PolygonMap({{wallRing({{0, 0}, {4, 0}, {0, 3}}), {}}}));
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-7}) {
    EXPECT_THROW(VisibleEdgeIndex(t, size, 1), InvalidParamsError) << size;
  }
  EXPECT_TRUE(VisibleEdgeIndex(t, 1e9, 1).covers({1, 1}));  // one square
  EXPECT_THROW(VisibleEdgeIndex(t, 0.5, 1, 0.0), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
