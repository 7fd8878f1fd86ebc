#include "tests/support/constants.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <tests/support/star_polygons.h>
#include <thread>

namespace mrpt_polyloc {
namespace {

using test::kNaNF;

TEST(CirclePlanTest, TakesEvenFiveSmoothNumbersOnly) {
  for (const std::size_t k : {2U, 4U, 6U, 8U, 10U, 12U, 360U, 512U, 720U, 1U << 20})
    EXPECT_EQ(CirclePlan::forSamples(k).size(), k);
  for (const std::size_t k : {0U, 1U, 3U, 14U, 22U, 225U, 361U, 362U, 1U << 21})
    EXPECT_THROW(CirclePlan::forSamples(k), InvalidParamsError) << k;
  try {
    CirclePlan::forSamples(14);
  } catch (const InvalidParamsError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("k = 14"));
  }
}

TEST(CirclePlanTest, SpectrumAndCorrelationAgreeWithTheirSums) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-5, 5);
  for (const std::size_t k : {2U, 4U, 6U, 10U, 30U, 360U, 512U}) {
    std::vector<float> f(k), g(k);
    for (float& x : f) x = uniform(random);
    for (float& x : g) x = uniform(random);
    const CirclePlan& plan = CirclePlan::forSamples(k);
    const auto f_spectrum = plan.spectrum(f.data()), g_spectrum = plan.spectrum(g.data());
    ASSERT_EQ(f_spectrum.size(), k / 2 + 1);
    double f_norm = 0, g_norm = 0;
    for (std::size_t i = 0; i < k; ++i) f_norm += f[i] * f[i], g_norm += g[i] * g[i];
    const double norms = std::sqrt(f_norm * g_norm);
    for (std::size_t j = 0; j <= k / 2; ++j) {
      std::complex<double> sum = 0;
      for (std::size_t i = 0; i < k; ++i)
        sum += std::polar(static_cast<double>(f[i]),
                          -kTwoPi * static_cast<double>(i * j) / static_cast<double>(k));
      sum /= std::sqrt(static_cast<double>(k));
      EXPECT_NEAR(f_spectrum[j].real(), sum.real(), 1e-6 * std::sqrt(f_norm));
      EXPECT_NEAR(f_spectrum[j].imag(), sum.imag(), 1e-6 * std::sqrt(f_norm));
    }
    const float* const c = plan.correlation(f_spectrum.data(), g_spectrum.data());
    for (std::size_t s = 0; s < k; ++s) {
      double sum = 0;
      for (std::size_t i = 0; i < k; ++i)
        sum += static_cast<double>(f[(i + k - s) % k]) * static_cast<double>(g[i]);
      EXPECT_NEAR(c[s], sum, plan.correlationError() * norms) << k << " " << s;
    }
  }
}

TEST(CirclePlanTest, ThreadsShareOnePlan) {
  std::vector<const CirclePlan*> plans(8);
  std::vector<std::thread> threads;
  for (auto& plan : plans)
    threads.emplace_back([&plan] {
      for (const std::size_t k : {160U, 162U, 180U, 192U, 200U, 1000U})
        plan = &CirclePlan::forSamples(k);
    });
  for (auto& thread : threads) thread.join();
  for (const auto* plan : plans) EXPECT_EQ(plan, &CirclePlan::forSamples(1000));
}

TEST(SampledPolarFunctionTest, SamplesTheFunction) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    const auto polygon = test::randomStarPolygon(random, 12);
    const auto f = PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
    const SampledPolarFunction sampled(f, 720);
    ASSERT_EQ(sampled.size(), 720U);
    EXPECT_TRUE(sampled.isComplete());
    EXPECT_EQ(sampled.validCount(), 720U);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < 720; ++i) {
      const double phi = kTwoPi * static_cast<double>(i) / 720;
      EXPECT_NEAR(sampled.samples()[i], f.value(phi), 1e-6 * f.value(phi));
      sum += f.value(phi);
      squares += f.value(phi) * f.value(phi);
    }
    EXPECT_NEAR(sampled.mean(), sum / 720, 1e-5);
    EXPECT_NEAR(sampled.squaredNorm(), kTwoPi / 720 * squares, 1e-5 * squares);
    // A sum of samples misses the integral by at most the spacing times the variation.
    EXPECT_NEAR(sampled.squaredNorm(), f.squaredNorm(),
                kTwoPi / 720 * 2 * f.maximum() * f.totalVariation());
  }
  EXPECT_EQ(
      SampledPolarFunction(PolarFunction::fromPolygon({{-1, -1}, {1, -1}, {0, 1}}, {0, 0})).size(),
      360U);
}

TEST(SampledPolarFunctionTest, UnseenSamplesAreInvalid) {
  std::vector<double> bearings, ranges;
  for (int i = -90; i <= 90; ++i) {
    bearings.push_back(i * kPi / 180);
    ranges.push_back(3.0);
  }
  const SampledPolarFunction f(PolarFunction::fromBeams(bearings, ranges), 360);
  EXPECT_FALSE(f.isComplete());
  EXPECT_EQ(f.validCount(), 181U);
  EXPECT_TRUE(f.isValid(90));
  EXPECT_FALSE(f.isValid(91));
  EXPECT_TRUE(f.isValid(270));
  EXPECT_FALSE(f.isValid(269));
  EXPECT_EQ(f.samples()[180], 0.0F);
  EXPECT_NEAR(f.mean(), 3.0, 1e-12);
  EXPECT_NEAR(f.squaredNorm(), kTwoPi / 360 * 181 * 9, 1e-9);
}

TEST(SampledPolarFunctionTest, RefusesWrongSamples) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THROW(SampledPolarFunction(std::vector<float>{}), InvalidParamsError);
  EXPECT_THROW(SampledPolarFunction(std::vector<float>(14, 1.0F)), InvalidParamsError);
  EXPECT_THROW(SampledPolarFunction({1.0F, infinity}), InvalidParamsError);
  EXPECT_THROW(SampledPolarFunction({-1.0F, 1.0F}), InvalidParamsError);
  EXPECT_THROW(SampledPolarFunction({kNaNF, kNaNF}), InvalidParamsError);
  EXPECT_EQ(SampledPolarFunction({kNaNF, 1.0F}).validCount(), 1U);
}

}  // namespace
}  // namespace mrpt_polyloc
