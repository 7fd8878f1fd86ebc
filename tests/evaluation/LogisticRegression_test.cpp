#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/LogisticRegression.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

using testing::HasSubstr;

/// What fitLogistic() minimises, written down once more: features scaled to deviation 1.
double penalisedLoss(const std::vector<LogisticSample>& samples, const LogisticModel& model,
                     double ridge) {
  const auto n = static_cast<double>(samples.size());
  double loss = 0.0;
  for (const LogisticSample& sample : samples) {
    double score = model.intercept;
    for (std::size_t j = 0; j < sample.features.size(); ++j) {
      score += model.weights[j] * sample.features[j];
    }
    loss -= sample.weight * std::log(1.0 / (1.0 + std::exp(sample.positive ? -score : score)));
  }
  for (std::size_t j = 0; j < model.weights.size(); ++j) {
    double mean = 0.0, square = 0.0;
    for (const LogisticSample& sample : samples) mean += sample.features[j] / n;
    for (const LogisticSample& sample : samples) {
      square += std::pow(sample.features[j] - mean, 2) / n;
    }
    loss += 0.5 * ridge * square * std::pow(model.weights[j], 2);
  }
  return loss;
}

std::vector<LogisticSample> drawSamples(std::size_t count, const std::vector<double>& weights,
                                        double intercept, std::uint64_t seed) {
  Random random(seed);
  std::vector<LogisticSample> samples(count);
  for (LogisticSample& sample : samples) {
    double score = intercept;
    for (const double weight : weights) {
      sample.features.push_back(3.0 + 2.0 * random.normal());
      score += weight * sample.features.back();
    }
    sample.positive = random.unit() < 1.0 / (1.0 + std::exp(-score));
    sample.weight = random.uniform(0.5, 2.0);
  }
  return samples;
}

TEST(Logistic, StaysWithinZeroAndOne) {
  EXPECT_EQ(logistic(0.0), 0.5);
  EXPECT_NEAR(logistic(2.0), 1.0 / (1.0 + std::exp(-2.0)), 1e-15);
  EXPECT_EQ(logistic(1e4), 1.0);
  EXPECT_EQ(logistic(-1e4), 0.0);
  EXPECT_NEAR(logistic(-3.0) + logistic(3.0), 1.0, 1e-15);
}

TEST(LogisticModel, ScoreIsTheWeightedSum) {
  const LogisticModel model{0.5, {2.0, -1.0}};
  EXPECT_EQ(model.score({3.0, 4.0}), 2.5);
  EXPECT_THROW(model.score({3.0}), std::out_of_range);
}

TEST(FitLogistic, WithOneGroupItIsTheOddsOfTheCounts) {
  // Without a feature that changes the best probability is the share: 3 of 4.
  std::vector<LogisticSample> samples{{{1.0}, true}, {{1.0}, true}, {{1.0}, true}, {{1.0}, false}};
  const LogisticModel model = fitLogistic(samples);
  EXPECT_EQ(model.weights[0], 0.0);
  EXPECT_NEAR(model.intercept, std::log(3.0), 1e-9);
}

TEST(FitLogistic, WithTwoGroupsItMeetsBothShares) {
  // Saturated: two groups, two parameters; without a penalty the fit is exact.
  std::vector<LogisticSample> samples;
  const auto add = [&](double feature, bool positive, double weight) {
    samples.push_back({{feature}, positive, weight});
  };
  add(1.0, true, 1.0);
  add(1.0, false, 4.0);
  add(5.0, true, 9.0);
  add(5.0, false, 2.0);
  LogisticFitParams params;
  params.ridge = 1e-9;
  const LogisticModel model = fitLogistic(samples, params);
  EXPECT_NEAR(model.score({1.0}), std::log(1.0 / 4.0), 1e-6);
  EXPECT_NEAR(model.score({5.0}), std::log(9.0 / 2.0), 1e-6);
}

TEST(FitLogistic, TheLossHasItsMinimumThere) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    SCOPED_TRACE(seed);
    const auto samples = drawSamples(200, {1.5, -0.7, 0.0}, -2.0, seed);
    for (const double ridge : {0.01, 1.0, 30.0}) {
      LogisticFitParams params;
      params.ridge = ridge;
      const LogisticModel model = fitLogistic(samples, params);
      const double least = penalisedLoss(samples, model, ridge);
      // The derivative by the j-th weight; past the last one by the intercept.
      for (std::size_t j = 0; j <= model.weights.size(); ++j) {
        constexpr double kStep = 1e-5;
        LogisticModel above = model, below = model;
        (j < model.weights.size() ? above.weights[j] : above.intercept) += kStep;
        (j < model.weights.size() ? below.weights[j] : below.intercept) -= kStep;
        const double up = penalisedLoss(samples, above, ridge);
        const double down = penalisedLoss(samples, below, ridge);
        EXPECT_GE(up, least);
        EXPECT_GE(down, least);
        EXPECT_NEAR((up - down) / (2 * kStep), 0.0, 1e-4);
      }
    }
  }
}

TEST(FitLogistic, FindsTheWeightsThatMadeTheData) {
  const LogisticModel model = fitLogistic(drawSamples(40000, {1.0, -0.5}, -1.5, 7));
  EXPECT_NEAR(model.weights[0], 1.0, 0.05);
  EXPECT_NEAR(model.weights[1], -0.5, 0.05);
  EXPECT_NEAR(model.intercept, -1.5, 0.15);
}

TEST(FitLogistic, AWeightCountsAsSoManySamples) {
  std::vector<LogisticSample> once{{{0.0}, true}, {{1.0}, false}, {{2.0}, true}, {{4.0}, false}};
  std::vector<LogisticSample> repeated = once;
  for (LogisticSample& sample : once) sample.weight = 3.0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 4; ++j) repeated.push_back(repeated[static_cast<std::size_t>(j)]);
  }
  const LogisticModel a = fitLogistic(once), b = fitLogistic(repeated);
  EXPECT_NEAR(a.weights[0], b.weights[0], 1e-9);
  EXPECT_NEAR(a.intercept, b.intercept, 1e-9);
}

TEST(FitLogistic, SeparableDataStayFinite) {
  std::vector<LogisticSample> samples;
  for (int i = 0; i < 50; ++i) samples.push_back({{i < 25 ? -1.0 - i : 1.0 + i}, i >= 25});
  const LogisticModel model = fitLogistic(samples);
  EXPECT_TRUE(std::isfinite(model.weights[0]));
  EXPECT_GT(model.weights[0], 0.0);
}

TEST(FitLogistic, RefusesWhatCannotBeFitted) {
  const auto complaint = [](const std::vector<LogisticSample>& samples,
                            const LogisticFitParams& params = {}) {
    try {
      fitLogistic(samples, params);
    } catch (const InvalidParamsError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint({}), HasSubstr("no positive sample"));
  EXPECT_THAT(complaint({{{1.0}, true}}), HasSubstr("no negative sample"));
  EXPECT_THAT(complaint({{{1.0}, false}}), HasSubstr("no positive sample"));
  EXPECT_THAT(complaint({{{1.0}, true}, {{1.0, 2.0}, false}}),
              HasSubstr("sample 1 has 2 features"));
  EXPECT_THAT(complaint({{{1.0}, true}, {{nan}, false}}), HasSubstr("sample 1: a feature"));
  EXPECT_THAT(complaint({{{1.0}, true, 0.0}, {{2.0}, false}}), HasSubstr("sample 0: weight"));
  LogisticFitParams params;
  params.ridge = -1.0;
  EXPECT_THAT(complaint({{{1.0}, true}, {{2.0}, false}}, params), HasSubstr("ridge"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
