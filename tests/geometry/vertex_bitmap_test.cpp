#include <mrpt_polyloc/geometry/vertex_bitmap.h>

#include <gtest/gtest.h>

#include <random>

namespace mrpt_polyloc::test {
namespace {

bool inClosedTriangle(const LatticePoint& p, const std::array<LatticePoint, 3>& t) {
  const bool left =
      cross(t[0], t[1], p) >= 0 && cross(t[1], t[2], p) >= 0 && cross(t[2], t[0], p) >= 0;
  const bool right =
      cross(t[0], t[1], p) <= 0 && cross(t[1], t[2], p) <= 0 && cross(t[2], t[0], p) <= 0;
  return left || right;
}

TEST(VertexBitmap, FindsWhatBruteForceFinds) {
  constexpr int kColumns = 150;
  constexpr int kRows = 40;
  std::mt19937 random(11);
  const auto draw = [&random] {
    return LatticePoint{std::uniform_int_distribution<int>(0, kColumns - 1)(random),
                        std::uniform_int_distribution<int>(0, kRows - 1)(random)};
  };
  int found = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::array<LatticePoint, 3> triangle{draw(), draw(), draw()};
    if (cross(triangle[0], triangle[1], triangle[2]) == 0) continue;
    VertexBitmap bitmap(kColumns, kRows);
    for (const LatticePoint& p : triangle) bitmap.insert(p);
    bool expected = false;
    for (int i = 0; i < 3; ++i) {
      const LatticePoint p = draw();
      bitmap.insert(p);
      const bool own = p == triangle[0] || p == triangle[1] || p == triangle[2];
      expected = expected || (!own && inClosedTriangle(p, triangle));
    }
    ASSERT_EQ(bitmap.hasOtherIn(triangle), expected) << "round " << round;
    ASSERT_EQ(bitmap.hasOtherIn(triangle), expected) << "asked twice";
    found += expected;
  }
  EXPECT_GT(found, 500);
}

TEST(VertexBitmap, PointsOnTheBorderCount) {
  VertexBitmap bitmap(70, 10);
  const std::array<LatticePoint, 3> triangle{{{0, 0}, {68, 0}, {0, 8}}};
  for (const LatticePoint& p : triangle) bitmap.insert(p);
  EXPECT_FALSE(bitmap.hasOtherIn(triangle));
  for (const LatticePoint& p : {LatticePoint{64, 0}, LatticePoint{0, 3}, LatticePoint{34, 4}}) {
    bitmap.insert(p);
    EXPECT_TRUE(bitmap.hasOtherIn(triangle)) << p.x << ", " << p.y;
    bitmap.erase(p);
    EXPECT_FALSE(bitmap.hasOtherIn(triangle));
  }
}

TEST(VertexBitmap, CollinearTriangleIsASegment) {
  VertexBitmap bitmap(20, 20);
  const std::array<LatticePoint, 3> triangle{{{2, 2}, {6, 6}, {10, 10}}};
  for (const LatticePoint& p : triangle) bitmap.insert(p);
  bitmap.insert({7, 6});
  bitmap.insert({12, 12});
  EXPECT_FALSE(bitmap.hasOtherIn(triangle));
  bitmap.insert({9, 9});
  EXPECT_TRUE(bitmap.hasOtherIn(triangle));
}

}  // namespace
}  // namespace mrpt_polyloc::test
