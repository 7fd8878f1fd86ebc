#include "tests/support/feature_distance.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/FourierBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gtest/gtest.h>

#include <tests/support/star_polygons.h>

namespace mrpt_polyloc {
namespace {

double norm(const std::vector<double>& x) {
  return test::featureDistance(x, std::vector<double>(x.size(), 0.0));
}

PolarFunction randomFunction(std::mt19937& random) {
  const auto polygon = test::randomStarPolygon(random, 4 + random() % 25);
  return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
}

TEST(FourierBoundTest, NeverExceedsTheSampledMetric) {
  std::mt19937 random(1);
  double ratio = 0.0;
  constexpr int kRounds = 500;
  for (int round = 0; round < kRounds; ++round) {
    const SampledPolarFunction f(randomFunction(random)), g(randomFunction(random));
    const double truth = distanceOverRotations(f, g).distance;
    double previous = 0.0;
    for (const std::size_t order : {0U, 1U, 4U, 16U, 64U, 179U}) {
      const double bound =
          test::featureDistance(fourierFeature(f, order), fourierFeature(g, order));
      EXPECT_LE(bound, truth + 1e-5) << round << " " << order;
      EXPECT_GE(bound, previous - 1e-5) << round << " " << order;  // more terms, more is seen
      previous = bound;
    }
    ratio += previous / truth / kRounds;
  }
  EXPECT_GT(ratio, 0.3);  // it bounds, and it is of use
}

TEST(FourierBoundTest, DoesNotChangeUnderRotation) {
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    const PolarFunction f = randomFunction(random);
    EXPECT_NEAR(
        test::featureDistance(fourierFeature(f, 20), fourierFeature(f.turned(1.0 + round), 20)),
        0.0, 1e-6);
    EXPECT_NEAR(norm(fourierFeature(f, 20)), std::sqrt(f.squaredNorm()), 1e-9);
    const SampledPolarFunction sampled(f);
    EXPECT_NEAR(norm(fourierFeature(sampled, 20)), std::sqrt(sampled.squaredNorm()), 1e-6);
  }
}

TEST(FourierBoundTest, OfOrderZeroIsMeanAndRest) {
  const auto square = PolarFunction::fromPolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0});
  const auto x = fourierFeature(square, 0);
  ASSERT_EQ(x.size(), 2U);
  const double mean = 8.0 * std::asinh(1.0) / kTwoPi;
  EXPECT_NEAR(x[0], std::sqrt(kTwoPi) * mean, 1e-12);
  EXPECT_NEAR(x[1], std::sqrt(8.0 - kTwoPi * mean * mean), 1e-9);
}

TEST(FourierBoundTest, RefusesPartialViewsAndWrongOrders) {
  const auto partial = PolarFunction::fromBeams({0, 0.1}, {1, 1});
  EXPECT_THROW(fourierFeature(partial, 2), InvalidParamsError);
  EXPECT_THROW(fourierFeature(SampledPolarFunction(partial), 2), InvalidParamsError);
  const SampledPolarFunction two(std::vector<float>{1.0F, 2.0F});
  EXPECT_EQ(fourierFeature(two, 0).size(), 2U);
  EXPECT_THROW(fourierFeature(two, 1), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
