#include "tests/support/exact_polar_metric.h"

#include "tests/support/feature_distance.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/FourierBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gtest/gtest.h>

#include <limits>
#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPoint2D;
using test::integralOver;
using test::quadratureDistance;
using test::randomPolarFunction;
using test::randomView;

PolarFunction square(double side, const TPoint2D& kernel) {
  const double h = side / 2;
  return PolarFunction::fromPolygon({{-h, -h}, {h, -h}, {h, h}, {-h, h}}, kernel);
}

TEST(ExactPolarMetricTest, AgreesWithQuadrature) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-10, 10);
  for (int round = 0; round < 300; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const double rotation = round % 5 == 0 ? 0.0 : angle(random);
    const double expected = quadratureDistance(f, g, rotation);
    EXPECT_NEAR(distance(f, g, rotation), expected, 1e-6 * (1 + expected)) << round;
    EXPECT_NEAR(distance(f, g, rotation), distance(f.turned(rotation), g), 1e-7) << round;
  }
}

TEST(ExactPolarMetricTest, ParallelWallsInClosedForm) {
  // f = d / cos on four quadrants: the difference of two squares is 1 / cos on each.
  const PolarFunction f = square(2, {0, 0}), g = square(4, {0, 0});
  EXPECT_NEAR(distance(f, g), std::sqrt(8.0), 1e-14);
  EXPECT_NEAR(distance(f, g, kPi / 2), std::sqrt(8.0), 1e-14);
  for (const double turn : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, kPi / 2 + 1e-9}) {
    const double expected = std::sqrt(integralOver(
        f, g, turn, [](double a, double b) { return (a - b) * (a - b); }, 200));
    EXPECT_NEAR(distance(f, g, turn), expected, 1e-12 + turn * 1e-9) << turn;
  }
}

TEST(ExactPolarMetricTest, NearlyEqualViewsKeepTheirDigits) {
  // For a small turn t of a convex polygon the metric is t ||f'||, and f' = f tan on each wall.
  const PolarFunction f = square(2, {0.3, -0.2});
  double square_of_slope = 0.0;
  for (const auto& piece : f.pieces()) {
    const double psi = std::atan2(piece.normal.y, piece.normal.x);
    square_of_slope += test::gaussIntegral(piece.begin, piece.end, 200, [&](double phi) {
      const double derivative = f.value(phi) * std::tan(phi - psi);
      return derivative * derivative;
    });
  }
  const double slope = std::sqrt(square_of_slope);
  for (const double turn : {1e-4, 1e-6, 1e-8}) {
    EXPECT_NEAR(distance(f, f, turn) / turn, slope, 10 * turn + 1e-6) << turn;
  }
  EXPECT_EQ(distance(f, f), 0.0);
  EXPECT_NEAR(distance(f, f.scaled(1 + 1e-9)), 1e-9 * std::sqrt(f.squaredNorm()), 1e-15);
}

TEST(ExactPolarMetricTest, WallsAgainstArcsInClosedForm) {
  const PolarFunction f = square(2, {0, 0});
  const PolarFunction disk =
      PolarFunction::fromPolygon({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {0, 0}, 1.5);
  const double inner = 8.0 * 1.5 * std::asinh(1.0);  // of f and the radius
  EXPECT_NEAR(distance(f, disk), std::sqrt(8.0 + kTwoPi * 2.25 - 2 * inner), 1e-13);
  EXPECT_NEAR(distance(disk, f, 0.7), distance(f, disk), 1e-12);
  EXPECT_NEAR(distance(disk, disk.scaled(2.0)), 1.5 * std::sqrt(kTwoPi), 1e-13);
}

TEST(ExactPolarMetricTest, IsAMetric) {
  std::mt19937 random(2);
  for (int round = 0; round < 500; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random), h = randomView(random);
    EXPECT_NEAR(distance(f, g), distance(g, f), 1e-11);
    EXPECT_LE(distance(f, f), 3e-7 * f.maximum());
    EXPECT_GT(distance(f, g), 0.01);
    EXPECT_LE(distance(f, h), distance(f, g) + distance(g, h) + 1e-9);
  }
}

TEST(ExactPolarMetricTest, IsInvariantUnderCommonMotionsAndHomogeneous) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-10, 10);
  for (int round = 0; round < 200; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const double turn = angle(random), rotation = angle(random);
    const double d = distance(f, g, rotation);
    EXPECT_NEAR(distance(f.turned(turn), g.turned(turn), rotation), d, 1e-7);
    EXPECT_NEAR(distance(g, f, -rotation), d, 1e-9);
    EXPECT_NEAR(distance(f.scaled(0.01), g.scaled(0.01), rotation), 0.01 * d, 1e-9);
  }
}

TEST(ExactPolarMetricTest, CollinearVerticesChangeNothing) {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const auto polygon = test::randomStarPolygon(random, 9);
    auto padded = polygon;
    padded.vertices.clear();
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      const TPoint2D a = polygon.vertices[i];
      const TPoint2D b = polygon.vertices[(i + 1) % polygon.vertices.size()];
      padded.vertices.insert(padded.vertices.end(), {a, a + (b - a) * 0.25, a + (b - a) * 0.5});
    }
    const auto f = PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
    const auto g = PolarFunction::fromPolygon(padded.vertices, padded.kernel);
    const PolarFunction h = randomPolarFunction(random);
    EXPECT_NEAR(distance(f, g), 0.0, 1e-6);
    EXPECT_NEAR(distance(f, h), distance(g, h), 1e-9);
  }
}

TEST(ExactPolarMetricTest, ComparesWithTheSymmetricDifference) {
  std::mt19937 random(5);
  for (int round = 0; round < 200; ++round) {
    const PolarFunction f = randomPolarFunction(random), g = randomPolarFunction(random);
    const double twice_area = integralOver(
        f, g, 0.0, [](double a, double b) { return std::abs(a * a - b * b); }, 200);
    const double d = distance(f, g);
    EXPECT_LE(d * d, twice_area * (1 + 1e-4));
    EXPECT_LE(twice_area,
              d * (std::sqrt(f.squaredNorm()) + std::sqrt(g.squaredNorm())) * (1 + 1e-4));
  }
}

TEST(ExactPolarMetricTest, LowerBoundsStayBelow) {
  std::mt19937 random(6);
  for (int round = 0; round < 200; ++round) {
    const PolarFunction f = randomPolarFunction(random), g = randomPolarFunction(random);
    const double d = distance(f, g);
    EXPECT_LE(std::abs(std::sqrt(f.squaredNorm()) - std::sqrt(g.squaredNorm())), d + 1e-9);
    const double f_mean = f.fourierCoefficients(0)[0].real();
    const double g_mean = g.fourierCoefficients(0)[0].real();
    EXPECT_LE(std::sqrt(kTwoPi) * std::abs(f_mean - g_mean), d + 1e-9);
    for (const std::size_t order : {0U, 4U, 20U})
      EXPECT_LE(test::featureDistance(fourierFeature(f, order), fourierFeature(g, order)),
                d + 1e-9);
  }
}

TEST(ExactPolarMetricTest, SamplesMissItByNoMoreThanStated) {
  std::mt19937 random(7);
  for (int round = 0; round < 100; ++round) {
    const PolarFunction f = randomPolarFunction(random), g = randomPolarFunction(random);
    const double exact = distance(f, g);
    // The variation of (f - g)^2 is at most 2 max |f - g| times that of f - g.
    const double variation = 2 * std::max(f.maximum() - g.minimum(), g.maximum() - f.minimum()) *
                             (f.totalVariation() + g.totalVariation());
    for (const std::size_t k : {90U, 360U, 1440U}) {
      const double sampled = distance(SampledPolarFunction(f, k), SampledPolarFunction(g, k));
      EXPECT_LE(std::abs(sampled * sampled - exact * exact),
                kTwoPi / static_cast<double>(k) * variation);
    }
  }
}

TEST(ExactPolarMetricTest, PartialViewsAreComparedWhereTheySee) {
  std::mt19937 random(8);
  for (int round = 0; round < 50; ++round) {
    const auto scan = PolarFunction::fromBeams({-0.5, 0.0, 0.5, 1.0}, {1.0, 2.0, 3.0, 2.5});
    const PolarFunction f = randomPolarFunction(random);
    const double rotation = 0.37 * round;
    EXPECT_NEAR(distance(scan, f, rotation), quadratureDistance(scan, f, rotation), 1e-6);
    EXPECT_NEAR(distance(f, scan, rotation), quadratureDistance(f, scan, rotation), 1e-6);
    EXPECT_NEAR(distance(scan, scan, 0.0), 0.0, 0.0);
    EXPECT_NEAR(distance(scan, scan, 0.5), std::sqrt(0.5 * (1 + 1 + 0.25)), 1e-7);
    EXPECT_THROW(distance(scan, scan, kPi), InvalidParamsError);
  }
}

TEST(ExactPolarMetricTest, NeedlesAndGrazingWalls) {
  for (const double width : {1e-2, 1e-5, 1e-8}) {
    const auto needle =
        PolarFunction::fromPolygon({{-5, -width}, {5, -width}, {5, width}, {-5, width}}, {1, 0});
    const PolarFunction room = square(8, {0, 0});
    EXPECT_NEAR(distance(needle, needle), 0.0, 1e-12);
    // Far from the needle's direction it is nearly zero, so the room's norm remains.
    EXPECT_LE(std::abs(distance(needle, room) - std::sqrt(room.squaredNorm())),
              std::sqrt(needle.squaredNorm()) + 1e-9);
    EXPECT_LE(distance(needle, needle, 1e-9), 2 * std::sqrt(needle.squaredNorm()) + 1e-9);
    const auto close = PolarFunction::fromPolygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {width, 1});
    EXPECT_NEAR(distance(close, room), quadratureDistance(close, room), 0.02);
    EXPECT_TRUE(std::isfinite(distance(close, close, 1e-7)));
  }
  EXPECT_THROW(distance(square(1, {0, 0}), square(1, {0, 0}), std::nan("")), InvalidParamsError);
}

/// What is seen from p in the room [0, 10]^2 with a thin wall from (5, 0) to (5, 5), for p left of
/// it and low enough to see past its end onto the upper side.
PolarFunction viewPastWall(const TPoint2D& p) {
  const double share = (10 - p.y) / (5 - p.y);
  const TPoint2D far{p.x + share * (5 - p.x), 10.0};
  return PolarFunction::fromPolygon({{0, 0}, {5, 0}, {5, 5}, far, {0, 10}}, p);
}

TEST(ExactPolarMetricTest, MovingTheObserverIsHoelderContinuousWithExponentAHalf) {
  const TPoint2D p{2, 1};
  const PolarFunction f = viewPastWall(p);
  // At right angles to the window, whose jump is its length, 5 / 4 of the distance to the wall's
  // end. The sum over windows of jump^2 |delta| / |p - v| is the leading term.
  const double reach = std::hypot(3, 4), jump = reach * 5 / 4;
  double previous = 0.0;
  for (const double h : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double d = distance(f, viewPastWall({p.x - 0.8 * h, p.y + 0.6 * h}));
    EXPECT_NEAR(d / std::sqrt(h), jump / std::sqrt(reach), 3 * std::sqrt(h)) << h;
    if (previous > 0.0) {
      EXPECT_NEAR(std::log10(previous / d), 0.5, 0.06) << h;
    }
    previous = d;
  }
}

}  // namespace
}  // namespace mrpt_polyloc
