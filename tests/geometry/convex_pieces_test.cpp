#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/geometry/convex_pieces.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace mrpt_polyloc::test {
namespace {

constexpr double kSize = 0.3;

std::vector<TPoint2D> polygonOf(const ConvexPieces& pieces, const ConvexPieces::Piece& piece) {
  const auto first = pieces.vertices.begin() + piece.first;
  return {first, first + piece.count};
}

double cross(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool holds(const std::vector<TPoint2D>& polygon, const TPoint2D& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (cross(polygon[i], polygon[(i + 1) % polygon.size()], p) < -1e-9) return false;
  }
  return true;
}

void expectCellsFillFreeSpace(const PolygonMap& map) {
  const Triangulation triangulation(map);
  const TPoint2D corner = triangulation.box().min;
  const ConvexPieces pieces = convexPieces(triangulation, corner, kSize);
  double area = 0.0;
  std::size_t crossed = 0;
  for (const ConvexPieces::Piece& piece : pieces.pieces) {
    const std::vector<TPoint2D> polygon = polygonOf(pieces, piece);
    ASSERT_GE(polygon.size(), 3U);
    area += signedArea(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const TPoint2D& p = polygon[i];
      ASSERT_GE(cross(p, polygon[(i + 1) % polygon.size()], polygon[(i + 2) % polygon.size()]),
                -1e-9);
      // Within its square, up to rounding.
      ASSERT_GE(p.x, corner.x + piece.column * kSize - 1e-9);
      ASSERT_LE(p.x, corner.x + (piece.column + 1) * kSize + 1e-9);
      ASSERT_GE(p.y, corner.y + piece.row * kSize - 1e-9);
      ASSERT_LE(p.y, corner.y + (piece.row + 1) * kSize + 1e-9);
    }
    // No border inside: every vertex of the map is outside of the piece or on its border.
    for (const Ring* ring : map.rings()) {
      for (const TPoint2D& v : ring->vertices) {
        double least = 1e9;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
          const TPoint2D &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
          least = std::min(least, cross(a, b, v) / std::hypot(b.x - a.x, b.y - a.y));
        }
        crossed += least > 1e-6 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(crossed, 0U);
  EXPECT_NEAR(area, map.area(),
              1e-6 * map.area() + 1e-9 * static_cast<double>(pieces.pieces.size()));
}

TEST(ConvexPieces, FillFreeSpaceOfNamedMaps) {
  for (const auto& [name, map] : namedMaps()) {
    SCOPED_TRACE(name);
    expectCellsFillFreeSpace(map);
  }
}

TEST(ConvexPieces, FillFreeSpaceOfRandomMaps) {
  std::mt19937 random(1);
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectCellsFillFreeSpace(floorPlan(randomParams(random), seed));
  }
}

TEST(ConvexPieces, EachPointOfFreeSpaceLiesInOneOfItsSquare) {
  std::mt19937 random(2);
  const PolygonMap map = floorPlan(randomParams(random), 5);
  const Triangulation triangulation(map);
  const TPoint2D corner = triangulation.box().min;
  const ConvexPieces pieces = convexPieces(triangulation, corner, kSize);
  for (const TPoint2D& p : randomFreePoints(map, 500, random)) {
    const auto column = static_cast<std::int32_t>(std::floor((p.x - corner.x) / kSize));
    const auto row = static_cast<std::int32_t>(std::floor((p.y - corner.y) / kSize));
    EXPECT_TRUE(std::any_of(pieces.pieces.begin(), pieces.pieces.end(),
                            [&](const auto& piece) {
                              return piece.column == column && piece.row == row &&
                                     holds(polygonOf(pieces, piece), p);
                            }))
        << p.x << ' ' << p.y;
  }
}

TEST(ConvexPieces, SquaresInFreeSpaceStayWhole) {
  // 10 m by 10 m, cut by the triangulation's diagonal; the box begins 1 m outside.
  const Triangulation triangulation(squareMap());
  const ConvexPieces pieces = convexPieces(triangulation, triangulation.box().min, 0.5);
  EXPECT_EQ(pieces.pieces.size(), 400U);
  for (const ConvexPieces::Piece& piece : pieces.pieces) EXPECT_EQ(piece.count, 4U);
}

TEST(ConvexPieces, DoNotDependOnTheThreads) {
  std::mt19937 random(3);
  const Triangulation triangulation(floorPlan(randomParams(random), 7));
  const ConvexPieces one = convexPieces(triangulation, triangulation.box().min, kSize, 1);
  const ConvexPieces many = convexPieces(triangulation, triangulation.box().min, kSize, 4);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.pieces.size(), many.pieces.size());
}

}  // namespace
}  // namespace mrpt_polyloc::test
