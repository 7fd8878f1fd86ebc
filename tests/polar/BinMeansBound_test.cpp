#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/BinMeansBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <gtest/gtest.h>

#include <limits>
#include <tests/support/polar_oracle.h>

namespace mrpt_polyloc {
namespace {

/// Some samples of a view made invalid: a field of view, and a few gaps in it.
SampledPolarFunction partialView(const SampledPolarFunction& view, std::mt19937& random) {
  std::vector<float> samples = view.samples();
  const std::size_t k = samples.size(), begin = random() % k, seen = 1 + random() % k;
  for (std::size_t i = 0; i < k; ++i) {
    const bool is_unseen = (i + k - begin) % k >= seen || random() % 40 == 0;
    if (is_unseen) samples[i] = std::numeric_limits<float>::quiet_NaN();
  }
  samples[begin] = view.samples()[begin];
  return SampledPolarFunction(std::move(samples));
}

SampledPolarFunction cutOff(const SampledPolarFunction& view, double reach) {
  std::vector<float> samples = view.samples();
  for (float& sample : samples) sample = std::min(sample, static_cast<float>(reach));
  return SampledPolarFunction(std::move(samples));
}

TEST(BinMeansBoundTest, NeverExceedsTheSampledMetric) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double ratio = 0.0;
  constexpr int kRounds = 600;
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t k = round % 2 == 0 ? 180 : 90;
    const SampledPolarFunction whole(test::randomPolarFunction(random), k);
    const SampledPolarFunction g(test::randomPolarFunction(random), k);
    const SampledPolarFunction f = round % 3 == 0 ? whole : partialView(whole, random);
    const RotationRange range =
        round % 4 == 0 ? RotationRange{20 * unit(random) - 10, 3 * unit(random)} : RotationRange{};
    const double truth = distanceOverRotations(f, g, range).distance;
    const double cut = distanceOverRotations(f, cutOff(g, 3.0), range).distance;
    for (const std::size_t width : {1U, 2U, 8U, 64U}) {
      const BinMeansBound bound(f, width, range);
      EXPECT_LE(bound(g), truth) << round << " " << width;
      EXPECT_LE(bound(g, 3.0), cut) << round << " " << width;
      // With bins of one sample it is the metric itself.
      if (width == 1) {
        EXPECT_NEAR(bound(g), truth, 1e-3);
        EXPECT_NEAR(bound(g, 3.0), cut, 1e-3);
      }
      if (width == 8 && round % 3 == 0) ratio += bound(g) / truth / (kRounds / 3);
    }
  }
  EXPECT_GT(ratio, 0.6);
}

TEST(BinMeansBoundTest, BinsLieInValidRuns) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> samples(20, 1.0F);
  EXPECT_EQ(BinMeansBound(SampledPolarFunction(samples), 4).binCount(), 5U);
  samples[7] = none;  // runs of 7 and 12
  EXPECT_EQ(BinMeansBound(SampledPolarFunction(samples), 4).binCount(), 4U);
  samples.assign(20, none);
  samples[3] = 1.0F;
  const BinMeansBound nothing(SampledPolarFunction(samples), 2);
  EXPECT_EQ(nothing.binCount(), 0U);
  EXPECT_EQ(nothing(SampledPolarFunction(std::vector<float>(20, 2.0F))), 0.0);
}

TEST(BinMeansBoundTest, RefusesWhatItCannotBound) {
  const SampledPolarFunction view(std::vector<float>(20, 1.0F));
  for (const std::size_t width : {0U, 3U, 32U})
    EXPECT_THROW(BinMeansBound(view, width), InvalidParamsError) << width;
  EXPECT_THROW(BinMeansBound(view, 4, {0.0, -1.0}), InvalidParamsError);
  const BinMeansBound bound(view, 4);
  EXPECT_THROW(bound(SampledPolarFunction(std::vector<float>(30, 1.0F))), InvalidParamsError);
  std::vector<float> partial(20, 1.0F);
  partial[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(bound(SampledPolarFunction(partial)), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc
