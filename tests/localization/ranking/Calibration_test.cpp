#include "tests/support/params_messages.h"
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/ranking/default_calibration.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mrpt_polyloc {
namespace {

using testing::HasSubstr;

TEST(Calibration, IsTheBuiltInOneUnlessToldOtherwise) {
  const Calibration calibration;
  EXPECT_NO_THROW(calibration.check());
  EXPECT_EQ(calibration.match_intercept, default_calibration::kMatchIntercept);
  EXPECT_EQ(calibration.match_weights, default_calibration::kMatchWeights);
  EXPECT_EQ(calibration.least_match_probability, default_calibration::kLeastMatchProbability);
  EXPECT_EQ(calibration.lost_thresholds, default_calibration::kLostThresholds);
  EXPECT_EQ(calibration.weight_decay, default_calibration::kWeightDecay);
  EXPECT_EQ(calibration.unique_probability, default_calibration::kUniqueProbability);
  EXPECT_EQ(calibration.position_factor, default_calibration::kPositionFactor);
  EXPECT_EQ(calibration.heading_factor, default_calibration::kHeadingFactor);
}

TEST(Calibration, TheThresholdForAShareLosesNoMore) {
  Calibration calibration;
  calibration.lost_thresholds = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
  EXPECT_EQ(calibration.thresholdFor(0.0), 0.1);
  EXPECT_EQ(calibration.thresholdFor(0.0009), 0.1);
  EXPECT_EQ(calibration.thresholdFor(0.001), 0.2);
  EXPECT_EQ(calibration.thresholdFor(0.0299), 0.6);
  EXPECT_EQ(calibration.thresholdFor(0.03), 0.7);
  EXPECT_EQ(calibration.thresholdFor(1.0), 0.8);
  EXPECT_THROW(calibration.thresholdFor(-0.1), InvalidParamsError);
  EXPECT_THROW(calibration.thresholdFor(std::nan("")), InvalidParamsError);
}

TEST(Calibration, TheOddsOfAMatchAreTheExponentialOfTheScore) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Calibration calibration;
    calibration.match_intercept = 3.0 * normal(random);
    for (double& weight : calibration.match_weights) weight = 2.0 * normal(random);
    const MatchFeatures features{normal(random), normal(random), normal(random), normal(random),
                                 normal(random)};
    const double p = calibration.matchProbability(features);
    EXPECT_GE(p, 0.0);
    EXPECT_LE(p, 1.0);
    const long double score = static_cast<long double>(calibration.match_intercept) +
                              calibration.match_weights[0] * features.explained +
                              calibration.match_weights[1] * features.lead +
                              calibration.match_weights[2] * features.heading +
                              calibration.match_weights[3] * features.seen +
                              calibration.match_weights[4] * features.on_walls;
    if (std::abs(score) > 30) continue;
    const long double odds = static_cast<long double>(p) / (1.0L - static_cast<long double>(p));
    EXPECT_NEAR(static_cast<double>(std::log(odds) - score), 0.0, 1e-3) << score;
  }
  // Far out it is 0 and 1, not NaN.
  Calibration sure;
  sure.match_intercept = 1e300;
  EXPECT_EQ(sure.matchProbability({}), 1.0);
  sure.match_intercept = -1e300;
  EXPECT_EQ(sure.matchProbability({}), 0.0);
}

TEST(Calibration, AGoodFitIsAMatchAndABadOneIsNone) {
  const Calibration calibration;
  const double good = calibration.matchProbability({0.97, 1.0, std::log(0.003), 0.97, 0.95});
  const double bad = calibration.matchProbability({0.45, 0.05, std::log(0.03), 0.6, 0.4});
  EXPECT_GT(good, 0.9);
  EXPECT_LT(bad, 0.1);
}

TEST(Calibration, NamesTheBadField) {
  const auto complaint = [](const auto& spoil) {
    Calibration calibration;
    spoil(calibration);
    return test::complaintOf(calibration);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint([&](auto& c) { c.match_intercept = nan; }), HasSubstr("match_intercept"));
  EXPECT_THAT(complaint([&](auto& c) { c.match_weights[1] = HUGE_VAL; }),
              HasSubstr("match_weights.lead"));
  EXPECT_THAT(complaint([](auto& c) { c.least_match_probability = 1.5; }),
              HasSubstr("least_match_probability"));
  EXPECT_THAT(complaint([](auto& c) { c.weight_decay = 0.0; }), HasSubstr("weight_decay"));
  EXPECT_THAT(complaint([](auto& c) { c.unique_probability = -1.0; }),
              HasSubstr("unique_probability"));
  EXPECT_THAT(complaint([](auto& c) { c.position_factor = 0.0; }), HasSubstr("position_factor"));
  EXPECT_THAT(complaint([&](auto& c) { c.heading_factor = nan; }), HasSubstr("heading_factor"));
}

TEST(Calibration, SignsMakeSense) {
  const Calibration calibration;
  calibration.check();
  EXPECT_GT(calibration.match_weights[0], 0.0);  // explained
  EXPECT_GT(calibration.match_weights[1], 0.0);  // lead
  EXPECT_LT(calibration.match_weights[2], 0.0);  // heading
  EXPECT_GT(calibration.match_weights[3], 0.0);  // seen
  EXPECT_GT(calibration.matchProbability({1.0, 1.0, std::log(0.01), 1.0, 1.0}), 0.99);
  EXPECT_LT(calibration.matchProbability({0.3, 0.0, std::log(0.1), 0.8}), 0.01);
}

}  // namespace
}  // namespace mrpt_polyloc
