#include "tests/support/random_maps.h"
#include <mrpt_polyloc/visibility/BoundaryChains.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace mrpt_polyloc {
namespace {

double length(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs) {
  double sum = 0.0;
  for (const BoundaryChains::Run& run : runs) {
    for (std::uint32_t i = run.first; i < run.first + run.edges; ++i) {
      EXPECT_TRUE(chains.isEdge(i));
      sum += std::hypot(chains.x()[i + 1] - chains.x()[i], chains.y()[i + 1] - chains.y()[i]);
    }
    EXPECT_FALSE(chains.isEdge(run.first + run.edges));
  }
  return sum * chains.unit();
}

TEST(BoundaryChains, HoldAllWallsTwiceAndOpenEdgesOnce) {
  std::mt19937 random(61);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::FloorPlanParams params = test::randomParams(random);
    params.crossing_walls = 0;
    const PolygonMap map = test::floorPlan(params, seed);
    const Triangulation triangulation(map);
    const BoundaryChains chains(triangulation);
    EXPECT_NEAR(length(chains, chains.open()), map.openPerimeter(), 1e-4);
    double walls = 0.0;
    for (const Triangulation::Face& face : triangulation.faces()) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (face.passage[i] != Passage::wall) continue;
        walls += (triangulation.vertices()[static_cast<std::size_t>(face.vertex[(i + 1) % 3])] -
                  triangulation.vertices()[static_cast<std::size_t>(face.vertex[(i + 2) % 3])])
                     .norm();
      }
    }
    EXPECT_NEAR(length(chains, chains.walls()), walls, 1e-4);
  }
}

TEST(BoundaryChains, FollowABorderWithoutABreak) {
  // Around the room from inside, around the hole from outside; and the back of each.
  const PolygonMap map(
      {{wallRing({{0, 0}, {9, 0}, {9, 9}, {0, 9}}), {wallRing({{3, 3}, {3, 6}, {6, 6}, {6, 3}})}}});
  const Triangulation triangulation(map);
  const BoundaryChains chains(triangulation);
  ASSERT_EQ(chains.walls().size(), 4U);
  for (const BoundaryChains::Run& run : chains.walls()) {
    EXPECT_EQ(run.edges, 4U);
    EXPECT_EQ(chains.x()[run.first], chains.x()[run.first + 4]);  // closed
    EXPECT_EQ(chains.y()[run.first], chains.y()[run.first + 4]);
  }
  EXPECT_TRUE(chains.open().empty());
}

TEST(BoundaryChains, TurnAtTheEndOfAWall) {
  const PolygonMap map({{wallRing({{0, 0}, {9, 0}, {9, 9}, {0, 9}}), {}}}, {{{3, 3}, {6, 6}}});
  const Triangulation triangulation(map);
  const BoundaryChains chains(triangulation);
  std::size_t both_sides = 0;
  for (const BoundaryChains::Run& run : chains.walls()) both_sides += run.edges == 2 ? 1 : 0;
  EXPECT_EQ(both_sides, 1U);
}

TEST(BoundaryChains, AreExactFarFromTheOrigin) {
  const TPoint2D a(1e6, -1e6), b(1e6 + 30, -1e6), c(1e6 + 30, -1e6 + 20.123456789);
  const Triangulation triangulation(PolygonMap({{wallRing({a, b, c}), {}}}));
  const BoundaryChains chains(triangulation);
  EXPECT_LT(chains.unit(), 1e-7);
  const double height = (chains.fixedY(c.y) - chains.fixedY(b.y)) * chains.unit();
  EXPECT_NEAR(height, 20.123456789, 1e-7);
}

}  // namespace
}  // namespace mrpt_polyloc
