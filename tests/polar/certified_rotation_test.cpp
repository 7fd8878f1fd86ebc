#include "tests/support/certified_rotation.h"

#include "tests/support/exact_polar_metric.h"
#include "tests/support/feature_distance.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/FourierBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gtest/gtest.h>

#include <limits>
#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

using test::randomPolarFunction;
using test::randomView;

/// The least of n distances over a range of rotations: never below the minimum.
double leastOf(const PolarFunction& f, const PolarFunction& g, const RotationRange& range, int n) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= n; ++i)
    least = std::min(least, distance(f, g, range.center + range.tolerance * (2.0 * i / n - 1.0)));
  return least;
}

void expectCertificate(const CertifiedMatch& match, const PolarFunction& f, const PolarFunction& g,
                       double tolerance) {
  EXPECT_TRUE(match.within_tolerance);
  EXPECT_LE(match.lower_bound, match.distance);
  EXPECT_LE(match.distance - match.lower_bound, tolerance);
  EXPECT_NEAR(distance(f, g, match.rotation), match.distance, 1e-7);
  EXPECT_GT(match.evaluations, 0U);
}

TEST(RotationModulusTest, IsAnUpperBound) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-7, 0.5);
  for (int round = 0; round < 50; ++round) {
    const PolarFunction f = randomView(random);
    const RotationModulus modulus(f);
    EXPECT_EQ(modulus.bound(0.0), 0.0);
    for (int i = 0; i < 100; ++i) {
      const double h = std::pow(10.0, exponent(random));
      const double d = distance(f, f, h);
      EXPECT_LE(d, modulus.bound(h) + 1e-6) << round << " " << h;
      EXPECT_LE(modulus.bound(h), modulus.bound(1.01 * h) + 1e-12);
      if (h < 1e-4 && d > 0.01) {
        EXPECT_LE(modulus.bound(h), 5 * d);  // of use
      }
    }
  }
  EXPECT_THROW(RotationModulus(PolarFunction::fromBeams({0, 0.1}, {1, 1})), InvalidParamsError);
}

TEST(CertifiedRotationTest, HoldsTheMinimum) {
  std::mt19937 random(2);
  for (int round = 0; round < 40; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const CertifiedMatch match = distanceOverRotations(f, g, {}, {0.02, 1000000});
    expectCertificate(match, f, g, 0.02);
    EXPECT_LE(match.lower_bound, leastOf(f, g, {}, 5000) + 1e-9) << round;
  }
}

TEST(CertifiedRotationTest, FindsTheTurnOfAView) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-10, 10);
  for (int round = 0; round < 40; ++round) {
    const PolarFunction f = randomPolarFunction(random);
    const double turn = angle(random);
    const CertifiedMatch match = distanceOverRotations(f, f.turned(turn), {}, {0.01, 1000000});
    EXPECT_LE(match.distance, 0.01 + 1e-9);
    EXPECT_LE(angleBetween(match.rotation, turn), 0.01) << round;
  }
}

TEST(CertifiedRotationTest, KeepsToTheCompass) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-10, 10), share(0, 1);
  for (int round = 0; round < 40; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const RotationRange range{angle(random), kPi * share(random) * share(random)};
    const CertifiedMatch match = distanceOverRotations(f, g, range, {0.02, 1000000});
    expectCertificate(match, f, g, 0.02);
    EXPECT_LE(angleBetween(match.rotation, range.center), range.tolerance + 1e-9);
    EXPECT_LE(match.lower_bound, leastOf(f, g, range, 2000) + 1e-9) << round;
  }
  const PolarFunction f = randomView(random), g = randomView(random);
  const CertifiedMatch fixed = distanceOverRotations(f, g, {1.25, 0.0});
  EXPECT_DOUBLE_EQ(fixed.distance, distance(f, g, 1.25));
  EXPECT_EQ(fixed.lower_bound, fixed.distance);
  EXPECT_EQ(fixed.evaluations, 1U);
}

TEST(CertifiedRotationTest, PartialViews) {
  std::mt19937 random(5);
  std::vector<double> bearings, ranges;
  for (int i = -45; i <= 45; ++i) {
    bearings.push_back(i * kPi / 60);
    ranges.push_back(3.0 + 0.2 * (i % 5));
  }
  const auto scan = PolarFunction::fromBeams(bearings, ranges);
  for (int round = 0; round < 10; ++round) {
    const PolarFunction g = randomPolarFunction(random);
    const CertifiedMatch match = distanceOverRotations(scan, g, {}, {0.05, 1000000});
    expectCertificate(match, scan, g, 0.05);
    EXPECT_LE(match.lower_bound, leastOf(scan, g, {}, 3000) + 1e-9);
    const CertifiedMatch back = distanceOverRotations(g, scan, {}, {0.05, 1000000});
    EXPECT_NEAR(back.distance, match.distance, 0.05);
  }
  EXPECT_THROW(distanceOverRotations(scan, scan), InvalidParamsError);
}

TEST(CertifiedRotationTest, AgreesWithTheSampledMetric) {
  std::mt19937 random(6);
  for (int round = 0; round < 30; ++round) {
    const PolarFunction f = randomPolarFunction(random), g = randomPolarFunction(random);
    const CertifiedMatch exact = distanceOverRotations(f, g, {}, {0.02, 1000000});
    const RotationMatch sampled =
        distanceOverRotations(SampledPolarFunction(f, 720), SampledPolarFunction(g, 720));
    // Between the grid's rotations the metric falls by at most the modulus; samples miss the
    // integral by the variation of the squared difference.
    const double variation = 2 * std::max(f.maximum() - g.minimum(), g.maximum() - f.minimum()) *
                             (f.totalVariation() + g.totalVariation());
    const double error = kTwoPi / 720 * variation;
    const double nearest = exact.distance + RotationModulus(f).bound(kPi / 720);
    EXPECT_LE(sampled.distance * sampled.distance, nearest * nearest + error);
    EXPECT_GE(sampled.distance * sampled.distance + error, exact.lower_bound * exact.lower_bound);
    for (const std::size_t order : {2U, 16U})
      EXPECT_LE(test::featureDistance(fourierFeature(f, order), fourierFeature(g, order)),
                exact.distance + 1e-9);
  }
}

TEST(CertifiedRotationTest, IsAMetricModuloRotation) {
  std::mt19937 random(7);
  const CertificateParams params{0.02, 1000000};
  for (int round = 0; round < 15; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random), h = randomView(random);
    const auto fg = distanceOverRotations(f, g, {}, params);
    const auto gf = distanceOverRotations(g, f, {}, params);
    const auto gh = distanceOverRotations(g, h, {}, params);
    const auto fh = distanceOverRotations(f, h, {}, params);
    const auto turned = distanceOverRotations(f.turned(1.0), g.turned(-2.0), {}, params);
    EXPECT_LE(gf.lower_bound, fg.distance + 1e-9);
    EXPECT_LE(fg.lower_bound, gf.distance + 1e-9);
    EXPECT_LE(fh.lower_bound, fg.distance + gh.distance + 1e-9);
    EXPECT_LE(turned.lower_bound, fg.distance + 1e-6);
    EXPECT_LE(fg.lower_bound, turned.distance + 1e-6);
    EXPECT_LE(fg.distance, distance(f, g) + 0.02);
  }
}

TEST(CertifiedRotationTest, AnExhaustedBudgetIsSaidAndTheBoundStillHolds) {
  std::mt19937 random(8);
  const PolarFunction f = randomPolarFunction(random), g = randomPolarFunction(random);
  const CertifiedMatch match = distanceOverRotations(f, g, {}, {1e-9, 50});
  EXPECT_FALSE(match.within_tolerance);
  EXPECT_LE(match.evaluations, 60U);
  EXPECT_LE(match.lower_bound, leastOf(f, g, {}, 5000));
  EXPECT_GE(match.lower_bound, 0.0);
}

TEST(CertifiedRotationTest, RefusesWrongParams) {
  std::mt19937 random(9);
  const PolarFunction f = randomPolarFunction(random);
  EXPECT_THROW(distanceOverRotations(f, f, {0, 3.2}), InvalidParamsError);
  EXPECT_THROW(distanceOverRotations(f, f, {std::nan(""), 1}), InvalidParamsError);
  EXPECT_THROW(distanceOverRotations(f, f, {}, {0.0, 10}), InvalidParamsError);
  EXPECT_THROW(distanceOverRotations(f, f, {}, {0.1, 0}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
