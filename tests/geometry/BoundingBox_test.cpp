#include <mrpt_polyloc/geometry/BoundingBox.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mrpt_polyloc {
namespace {

TEST(BoundingBox, HoldsWhatItWasMadeOfAndTouchesIt) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-1e6, 1e6);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<TPoint2D> points(1 + random() % 9);
    for (TPoint2D& p : points) p = {coordinate(random), coordinate(random)};
    const BoundingBox box = BoundingBox::of(points);
    int low_x = 0, high_x = 0, low_y = 0, high_y = 0;
    for (const TPoint2D& p : points) {
      EXPECT_TRUE(box.contains(p));
      low_x += p.x == box.min.x, high_x += p.x == box.max.x;
      low_y += p.y == box.min.y, high_y += p.y == box.max.y;
    }
    EXPECT_TRUE(low_x > 0 && high_x > 0 && low_y > 0 && high_y > 0);
    EXPECT_FALSE(box.contains({std::nextafter(box.max.x, 2e6), box.min.y}));
    EXPECT_FALSE(box.contains({box.min.x, std::nextafter(box.min.y, -2e6)}));
  }
}

TEST(BoundingBox, OfNothingHoldsNothingAndAddsNothing) {
  BoundingBox box = BoundingBox::empty();
  EXPECT_TRUE(box.isEmpty());
  EXPECT_FALSE(box.contains({0, 0}));
  box.include(BoundingBox::of(std::vector<TPoint2D>{{1, 2}, {4, 8}}));
  box.include(BoundingBox::empty());
  EXPECT_FALSE(box.isEmpty());
  EXPECT_EQ(box.min, TPoint2D(1, 2));
  EXPECT_EQ(box.width(), 3.0);
  EXPECT_EQ(box.height(), 6.0);
  EXPECT_FALSE(box.contains({NAN, 3}));
}

}  // namespace
}  // namespace mrpt_polyloc
