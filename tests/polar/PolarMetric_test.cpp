#include "tests/support/constants.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <tests/support/star_polygons.h>

namespace mrpt_polyloc {
namespace {

using test::kNaNF;

constexpr std::size_t kSizes[] = {2, 4, 6, 10, 16, 30, 90, 360, 512, 720};

SampledPolarFunction randomView(std::mt19937& random, std::size_t k, double invalid = 0.0) {
  const auto polygon = test::randomStarPolygon(random, 4 + random() % 20);
  std::vector<float> samples =
      SampledPolarFunction(PolarFunction::fromPolygon(polygon.vertices, polygon.kernel), k)
          .samples();
  std::bernoulli_distribution drop(invalid);
  for (std::size_t i = 1; i < k; ++i)
    if (drop(random)) samples[i] = kNaNF;
  return SampledPolarFunction(samples);
}

SampledPolarFunction shifted(const SampledPolarFunction& f, std::size_t s) {
  std::vector<float> samples(f.size());
  for (std::size_t i = 0; i < f.size(); ++i)
    samples[(i + s) % f.size()] = f.isValid(i) ? f.samples()[i] : kNaNF;
  return SampledPolarFunction(samples);
}

/// By the definition, f turned by s steps.
double directDistance(const SampledPolarFunction& f, const SampledPolarFunction& g, std::size_t s) {
  const std::size_t k = f.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < k; ++i) {
    const std::size_t j = (i + k - s) % k;
    if (!f.isValid(j) || !g.isValid(i)) continue;
    const double e = static_cast<double>(f.samples()[j]) - static_cast<double>(g.samples()[i]);
    sum += e * e;
  }
  return std::sqrt(kTwoPi / static_cast<double>(k) * sum);
}

/// The best of the rotations that a range holds, by trying them all.
double directLeast(const SampledPolarFunction& f, const SampledPolarFunction& g,
                   const RotationRange& range) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < f.size(); ++s)
    if (angleBetween(kTwoPi * static_cast<double>(s) / static_cast<double>(f.size()),
                     range.center) <= range.tolerance)
      least = std::min(least, directDistance(f, g, s));
  return least;
}

void expectConsistent(const RotationMatch& match, const SampledPolarFunction& f,
                      const SampledPolarFunction& g) {
  const double step = kTwoPi / static_cast<double>(f.size());
  ASSERT_LT(match.index, f.size());
  EXPECT_NEAR(match.rotation, step * static_cast<double>(match.index), 1e-12);
  EXPECT_LE(angleBetween(match.finer_rotation, match.rotation), step / 2 + 1e-12);
  EXPECT_NEAR(match.distance, directDistance(f, g, match.index), 1e-9 * (1 + match.distance));
}

TEST(PolarMetricTest, AgreesWithTheSumsOverAllRotations) {
  std::mt19937 random(1);
  for (const std::size_t k : kSizes)
    for (int round = 0; round < 20; ++round) {
      const auto f = randomView(random, k), g = randomView(random, k);
      EXPECT_NEAR(distance(f, g), directDistance(f, g, 0), 1e-9);
      const RotationMatch match = distanceOverRotations(f, g);
      expectConsistent(match, f, g);
      EXPECT_NEAR(match.distance, directLeast(f, g, {}), 1e-9) << k << " " << round;
    }
}

TEST(PolarMetricTest, PartialViewsAreComparedWhereTheySee) {
  std::mt19937 random(2);
  for (const std::size_t k : kSizes)
    for (int round = 0; round < 20; ++round) {
      const auto f = randomView(random, k, 0.5), g = randomView(random, k);
      EXPECT_NEAR(distance(f, g), directDistance(f, g, 0), 1e-9);
      EXPECT_NEAR(distance(g, f), directDistance(g, f, 0), 1e-9);
      const RotationMatch match = distanceOverRotations(f, g);
      expectConsistent(match, f, g);
      EXPECT_NEAR(match.distance, directLeast(f, g, {}), 1e-9) << k << " " << round;
      const RotationMatch back = distanceOverRotations(g, f);
      expectConsistent(back, g, f);
      EXPECT_NEAR(back.distance, match.distance, 1e-9);
      EXPECT_LE(match.distance, distanceOverRotations(g, shifted(g, 1)).distance +
                                    distanceOverRotations(f, g).distance + 1e-9);
    }
}

TEST(PolarMetricTest, TwoPartialViews) {
  const SampledPolarFunction f({1, 2, kNaNF, 4}), g({2, kNaNF, 3, 6}), h({kNaNF, kNaNF, 1, kNaNF});
  EXPECT_NEAR(distance(f, g), std::sqrt(kPi / 2 * (1 + 4)), 1e-12);
  EXPECT_THROW(distance(f, h), InvalidParamsError);
  EXPECT_THROW(distanceOverRotations(f, g), InvalidParamsError);
}

TEST(PolarMetricTest, ACompassLimitsTheRotations) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-10, 10), share(0, 1);
  for (const std::size_t k : kSizes)
    for (int round = 0; round < 30; ++round) {
      const bool partial = round % 3 == 0;
      const auto f = randomView(random, k, partial ? 0.3 : 0.0), g = randomView(random, k);
      const RotationRange range{angle(random), kPi * share(random) * share(random)};
      const RotationMatch match = distanceOverRotations(f, g, range);
      expectConsistent(match, f, g);
      const double least = directLeast(f, g, range);
      const double step = kTwoPi / static_cast<double>(k);
      if (std::isinf(least)) {
        EXPECT_LE(angleBetween(match.rotation, range.center), step / 2 + 1e-9);
      } else {
        EXPECT_LE(angleBetween(match.rotation, range.center), range.tolerance + 1e-6);
        EXPECT_NEAR(match.distance, least, 1e-9) << k << " " << round;
      }
    }
}

TEST(PolarMetricTest, ExactCompassOnTheGridIsThePlainDistance) {
  std::mt19937 random(4);
  const auto f = randomView(random, 360), g = randomView(random, 360);
  EXPECT_NEAR(distanceOverRotations(f, g, {0.0, 0.0}).distance, distance(f, g), 1e-12);
  EXPECT_EQ(distanceOverRotations(f, g, {-kPi / 180, 0.0}).index, 359U);
  // Bounds on the grid belong to the range.
  EXPECT_NEAR(distanceOverRotations(f, g, {0.0, 10 * kPi / 180}).distance,
              directLeast(f, g, {0.0, 10.01 * kPi / 180}), 1e-12);
}

TEST(PolarMetricTest, RefusesWrongRangesAndSizes) {
  std::mt19937 random(5);
  const auto f = randomView(random, 360), g = randomView(random, 512);
  EXPECT_THROW(distance(f, g), InvalidParamsError);
  EXPECT_THROW(distanceOverRotations(f, g), InvalidParamsError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const RotationRange& range : {RotationRange{0, 3.2}, RotationRange{0, -0.1},
                                     RotationRange{0, nan}, RotationRange{nan, 1}})
    EXPECT_THROW(distanceOverRotations(f, f, range), InvalidParamsError);
}

TEST(PolarMetricTest, FindsTheRotationOfAView) {
  std::mt19937 random(6);
  for (int round = 0; round < 50; ++round) {
    const auto f = randomView(random, 360);
    const std::size_t s = random() % 360;
    const RotationMatch match = distanceOverRotations(f, shifted(f, s));
    EXPECT_EQ(match.index, s);
    EXPECT_EQ(match.distance, 0.0);
  }
}

TEST(PolarMetricTest, TheParabolaComesCloserThanTheGrid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0, kTwoPi);
  const double step = kTwoPi / 360;
  double error = 0.0;
  for (int round = 0; round < 200; ++round) {
    // A convex polygon: no jumps, so the distance is smooth in the rotation.
    std::vector<mrpt::math::TPoint2D> vertices;
    for (int i = 0; i < 5; ++i)
      vertices.emplace_back(3 * std::cos(1.25 * i), 4 * std::sin(1.25 * i));
    const auto f = PolarFunction::fromPolygon(vertices, {0.5, 0.2});
    const double turn = angle(random);
    const auto match =
        distanceOverRotations(SampledPolarFunction(f), SampledPolarFunction(f.turned(turn)));
    EXPECT_LE(angleBetween(match.rotation, turn), step);
    error += angleBetween(match.finer_rotation, turn) / 200;
  }
  EXPECT_LT(error, step / 10);  // the grid alone: step / 4 on average
}

TEST(PolarMetricTest, SymmetricViewsTakeTheLeastRotation) {
  const SampledPolarFunction circle(std::vector<float>(360, 2.0F));
  EXPECT_EQ(distanceOverRotations(circle, circle).index, 0U);
  EXPECT_EQ(distanceOverRotations(circle, circle).distance, 0.0);
  const SampledPolarFunction square(
      PolarFunction::fromPolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0}));
  EXPECT_LT(distanceOverRotations(square, square).index % 90, 1U);
  EXPECT_NEAR(distanceOverRotations(square, square).distance, 0.0, 1e-6);
}

TEST(PolarMetricTest, IsAMetricModuloRotation) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const auto f = randomView(random, 360), g = randomView(random, 360),
               h = randomView(random, 360);
    EXPECT_DOUBLE_EQ(distance(f, g), distance(g, f));
    EXPECT_EQ(distance(f, f), 0.0);
    EXPECT_GT(distance(f, g), 0.0);
    EXPECT_LE(distance(f, h), distance(f, g) + distance(g, h) + 1e-9);
    const double fg = distanceOverRotations(f, g).distance;
    const double gh = distanceOverRotations(g, h).distance;
    EXPECT_NEAR(distanceOverRotations(g, f).distance, fg, 1e-9);
    EXPECT_LE(distanceOverRotations(f, h).distance, fg + gh + 1e-9);
    EXPECT_LE(fg, distance(f, g) + 1e-12);
    EXPECT_GE(fg, std::abs(std::sqrt(f.squaredNorm()) - std::sqrt(g.squaredNorm())) - 1e-9);
    EXPECT_NEAR(
        distanceOverRotations(shifted(f, random() % 360), shifted(g, random() % 360)).distance, fg,
        1e-9);
  }
}

TEST(PolarMetricTest, IsHomogeneous) {
  std::mt19937 random(9);
  for (int round = 0; round < 50; ++round) {
    const auto p = test::randomStarPolygon(random, 15), q = test::randomStarPolygon(random, 15);
    const auto f = PolarFunction::fromPolygon(p.vertices, p.kernel);
    const auto g = PolarFunction::fromPolygon(q.vertices, q.kernel);
    const auto at = [&](double scale) {
      return distanceOverRotations(SampledPolarFunction(f.scaled(scale)),
                                   SampledPolarFunction(g.scaled(scale)))
          .distance;
    };
    EXPECT_NEAR(at(7.5), 7.5 * at(1.0), 1e-4);
  }
}

}  // namespace
}  // namespace mrpt_polyloc
