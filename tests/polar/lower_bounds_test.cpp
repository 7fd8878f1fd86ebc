#include "tests/support/lower_bounds.h"

#include "tests/support/certified_rotation.h"
#include "tests/support/exact_polar_metric.h"
#include "tests/support/feature_distance.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/FourierBound.h>

#include <gtest/gtest.h>

#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

using test::randomView;

/// The least exact distance over many rotations of a range, the ends included: not below the
/// minimum.
double leastSampled(const PolarFunction& f, const PolarFunction& g, const RotationRange& range) {
  double least = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 300;
  for (int i = 0; i <= kSteps; ++i) {
    const double turn = range.tolerance * (2.0 * i / kSteps - 1.0);
    least = std::min(least, distance(f, g, range.center + turn));
  }
  return least;
}

TEST(LowerBoundsTest, NeverExceedTheExactMetricOverRotations) {
  std::mt19937 random(21);
  double low_pass = 0.0, fourier = 0.0, norm = 0.0;
  constexpr int kRounds = 150;
  for (int round = 0; round < kRounds; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const double truth = distanceOverRotations(f, g, {}, {1e-3, 20000}).distance;
    EXPECT_LE(normBound(f, g), truth + 1e-9) << round;
    EXPECT_LE(meanBound(f, g), truth + 1e-9) << round;
    for (const std::size_t order : {0U, 1U, 3U, 12U, 40U}) {
      EXPECT_LE(lowPassBound(f, g, order), truth + 1e-9) << round << " " << order;
    }
    low_pass += lowPassBound(f, g, 40) / truth / kRounds;
    fourier +=
        test::featureDistance(fourierFeature(f, 40), fourierFeature(g, 40)) / truth / kRounds;
    norm += normBound(f, g) / truth / kRounds;
  }
  EXPECT_GT(low_pass, 0.85);  // they bound, and each that takes longer is closer
  EXPECT_GT(low_pass, fourier);
  EXPECT_GT(fourier, norm);
}

TEST(LowerBoundsTest, LowPassStaysBelowWithinACompassRange) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> angle(-10.0, 10.0);
  for (int round = 0; round < 150; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const RotationRange range{angle(random), round % 3 == 0 ? 0.0 : 0.05 * (round % 50)};
    const double truth = leastSampled(f, g, range);
    for (const std::size_t order : {0U, 1U, 5U, 20U}) {
      EXPECT_LE(lowPassBound(f, g, order, range), truth + 1e-9) << round << " " << order;
    }
    EXPECT_LE(lowPassBound(f, g, 5), lowPassBound(f, g, 5, range) + 0.05 * truth) << round;
  }
}

TEST(LowerBoundsTest, LowPassOfAViewTurnedIsNearlyNothing) {
  std::mt19937 random(23);
  for (int round = 0; round < 50; ++round) {
    const PolarFunction f = randomView(random);
    // What the bound of C'' leaves open.
    EXPECT_LT(lowPassBound(f, f.turned(0.1 * round), 8), 0.15 * std::sqrt(f.squaredNorm()));
  }
}

TEST(LowerBoundsTest, BinMeansStayBelowWithACompass) {
  std::mt19937 random(24);
  double ratio = 0.0;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    const PolarFunction f = randomView(random), g = randomView(random);
    const double truth = distance(f, g);
    double previous = 0.0;
    for (const std::size_t bins : {1U, 2U, 4U, 16U, 64U, 1024U}) {
      const double bound = binMeansBound(f, g, bins);
      EXPECT_LE(bound, truth + 1e-9) << round << " " << bins;
      EXPECT_GE(bound, previous - 1e-9) << round << " " << bins;  // each halves those before
      previous = bound;
    }
    ratio += previous / truth / kRounds;
    EXPECT_LE(binMeansBound(f, g, 7), truth + 1e-9);
  }
  EXPECT_GT(ratio, 0.98);
}

TEST(LowerBoundsTest, BinMeansAreTheIntegrals) {
  std::mt19937 random(25);
  for (int round = 0; round < 50; ++round) {
    const PolarFunction f = randomView(random);
    // A circle of radius 1 has the mean 1 everywhere.
    const auto circle = PolarFunction::fromPolygon({{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, {0, 0}, 1);
    double sum = 0.0;
    constexpr int kBins = 5;
    for (int b = 0; b < kBins; ++b) {
      const double width = kTwoPi / kBins, from = b * width;
      double integral = 0.0;  // by quadrature between the breakpoints
      std::vector<double> breaks{from, from + width};
      for (const double x : f.breakpoints())
        if (x > from && x < from + width) breaks.push_back(x);
      std::sort(breaks.begin(), breaks.end());
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        integral += test::gaussIntegral(breaks[i], breaks[i + 1], 40,
                                        [&](double phi) { return f.value(phi); });
      sum += width * std::pow(integral / width - 1.0, 2);
    }
    EXPECT_NEAR(binMeansBound(f, circle, kBins), std::sqrt(sum), 1e-6) << round;
  }
}

TEST(LowerBoundsTest, RefuseWhatTheyCannotBound) {
  const auto partial = PolarFunction::fromBeams({0, 0.1}, {1, 1});
  const auto square = PolarFunction::fromPolygon({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0, 0});
  EXPECT_THROW(normBound(partial, square), InvalidParamsError);
  EXPECT_THROW(meanBound(square, partial), InvalidParamsError);
  EXPECT_THROW(lowPassBound(partial, square, 3), InvalidParamsError);
  EXPECT_THROW(lowPassBound(square, square, 3, {0.0, 4.0}), InvalidParamsError);
  EXPECT_THROW(binMeansBound(square, partial, 3), InvalidParamsError);
  EXPECT_THROW(binMeansBound(square, square, 0), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
