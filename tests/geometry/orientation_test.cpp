#include <mrpt_polyloc/geometry/orientation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <gmpxx.h>
#include <limits>
#include <random>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;
using Rational = mpq_class;  // the value of a double, exactly

int rationalOrientation(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) {
  const Rational det = (Rational(b.x) - Rational(a.x)) * (Rational(c.y) - Rational(a.y)) -
                       (Rational(b.y) - Rational(a.y)) * (Rational(c.x) - Rational(a.x));
  return sgn(det);
}

TEST(Orientation, IsTheSignOfTheTurn) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orientation({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orientation({0, 0}, {1, 1}, {3, 3}), 0);
  EXPECT_EQ(orientation({2, 5}, {2, 5}, {7, 1}), 0);
}

TEST(Orientation, EqualsRationalArithmeticNextToALine) {
  std::mt19937 random(20240601);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int signs[3] = {0, 0, 0};
  for (const double size : {1.0, 1e-6, 1e6}) {
    for (int i = 0; i < 4000; ++i) {
      // Few enough digits that points on the line are exactly on it.
      const auto coordinate = [&] {
        return static_cast<double>(static_cast<float>(size * uniform(random)));
      };
      const TPoint2D a(coordinate(), coordinate()), b(coordinate(), coordinate());
      const double s = std::round(24 * uniform(random)) / 8;
      TPoint2D c(a.x + s * (b.x - a.x), a.y + s * (b.y - a.y));
      const int steps = static_cast<int>(random() % 3);  // off the line by 0 to 2 last places
      for (int k = 0; k < steps; ++k) {
        c.x = std::nextafter(c.x, std::numeric_limits<double>::infinity());
      }
      const int expected = rationalOrientation(a, b, c);
      ++signs[expected + 1];
      ASSERT_EQ(orientation(a, b, c), expected) << i << " size " << size;
      ASSERT_EQ(exactOrientation(a, b, c), expected);
      ASSERT_EQ(orientation(b, a, c), -expected);
      ASSERT_EQ(orientation(b, c, a), expected);
    }
  }
  for (const int count : signs) EXPECT_GT(count, 20);  // all three were put to the test
}

TEST(Orientation, IsExactOnALatticeFarFromTheOrigin) {
  std::mt19937 random(7);
  const double last_place = std::ldexp(1.0, -32);  // of coordinates near 1e6
  const auto coordinate = [&] {
    return 1048576.0 + last_place * static_cast<double>(random() % 5);
  };
  for (int i = 0; i < 5000; ++i) {
    const TPoint2D a(coordinate(), coordinate()), b(coordinate(), coordinate());
    const TPoint2D c(coordinate(), coordinate());
    ASSERT_EQ(orientation(a, b, c), rationalOrientation(a, b, c));
  }
}

}  // namespace
}  // namespace mrpt_polyloc
