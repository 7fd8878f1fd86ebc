#include <mrpt_polyloc/evaluation/Summary.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

namespace mrpt_polyloc {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

LocalizationResult resultWith(LocalizationStatus status, std::vector<mrpt::math::TPose2D> poses) {
  LocalizationResult result;
  result.status = status;
  for (const auto& pose : poses) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = pose;
    result.hypotheses.push_back(hypothesis);
  }
  return result;
}

ScanScore score(LocalizationStatus status, std::size_t rank, double error_m, double ms) {
  ScanScore s;
  s.status = status;
  s.right_rank = rank;
  s.error_m = error_m;
  s.error_rad = error_m / 10.0;
  s.ms = ms;
  return s;
}

TEST(ScoreScanTest, FindsTheFirstRightHypothesis) {
  auto result = resultWith(LocalizationStatus::ambiguous,
                           {{5, 5, 0}, {1.0, 2.0, 0.2}, {1.0, 2.2, 0.05}, {1, 2, 0}});
  result.statistics.search_ms = 3.0;
  result.statistics.refinement_ms = 0.5;
  const ScanScore s = scoreScan(result, {1, 2, 0});
  EXPECT_EQ(s.right_rank, 3U);
  EXPECT_DOUBLE_EQ(s.error_m, 5.0);
  EXPECT_DOUBLE_EQ(s.error_rad, 0.0);
  EXPECT_DOUBLE_EQ(s.ms, 3.5);
  EXPECT_EQ(s.status, LocalizationStatus::ambiguous);
}

TEST(ScoreScanTest, ComparesHeadingsAcrossTheCut) {
  const auto result = resultWith(LocalizationStatus::unique, {{0, 0, M_PI - 0.01}});
  const ScanScore s = scoreScan(result, {0, 0, -M_PI + 0.02});
  EXPECT_EQ(s.right_rank, 1U);
  EXPECT_NEAR(s.error_rad, 0.03, 1e-12);
  EXPECT_NEAR(scoreScan(result, {0, 0, 5 * M_PI}).error_rad, 0.01, 1e-12);
}

TEST(ScoreScanTest, BothTolerancesCount) {
  const auto result = resultWith(LocalizationStatus::unique, {{0.25, 0, 0.125}});
  EXPECT_EQ(scoreScan(result, {0, 0, 0}, {0.25, 0.125}).right_rank, 1U);
  EXPECT_EQ(scoreScan(result, {0, 0, 0}, {0.24, 0.125}).right_rank, 0U);
  EXPECT_EQ(scoreScan(result, {0, 0, 0}, {0.25, 0.12}).right_rank, 0U);
}

TEST(ScoreScanTest, NoAnswerHasNoError) {
  const ScanScore s = scoreScan(resultWith(LocalizationStatus::no_match, {}), {0, 0, 0});
  EXPECT_EQ(s.right_rank, 0U);
  EXPECT_TRUE(std::isnan(s.error_m));
  EXPECT_TRUE(std::isnan(s.error_rad));
}

/// Of deviations 0.1 m along a line turned by 45 degrees, 0.01 m across it, and 0.02 rad.
Hypothesis slanted(double x, double phi) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = {x, 2.0, phi};
  const double along = 0.01, across = 0.0001, turn = 0.0004;
  hypothesis.covariance(0, 0) = hypothesis.covariance(1, 1) = 0.5 * (along + across);
  hypothesis.covariance(0, 1) = hypothesis.covariance(1, 0) = 0.5 * (along - across);
  hypothesis.covariance(2, 2) = turn;
  return hypothesis;
}

TEST(InEllipseTest, IsAMahalanobisDistanceOfThree) {
  const Hypothesis h = slanted(1.0, M_PI - 0.01);
  const auto at = [&](double along, double across, double turn) {
    const double s = std::sqrt(0.5);
    return isInEllipse(
        {1.0 + s * (along - across), 2.0 + s * (along + across), -M_PI - 0.01 + turn}, h);
  };
  EXPECT_TRUE(at(0, 0, 0));
  EXPECT_TRUE(at(0.299, 0, 0));
  EXPECT_FALSE(at(0.301, 0, 0));
  EXPECT_TRUE(at(0, 0.0299, 0));
  EXPECT_FALSE(at(0, 0.0301, 0));
  EXPECT_TRUE(at(0, 0, 0.0599));
  EXPECT_FALSE(at(0, 0, -0.0601));
  EXPECT_FALSE(at(0.22, 0.022, 0));  // 3.11 in all
  EXPECT_TRUE(isInEllipse({1.0, 2.3, M_PI - 0.01}, h, 22.0));
  EXPECT_FALSE(isInEllipse({1.0, 2.0, M_PI - 0.01}, Hypothesis{}));  // no covariance
}

TEST(InEllipseTest, AnyHypothesisCountsWhateverIsRight) {
  LocalizationResult result;
  result.status = LocalizationStatus::ambiguous;
  result.hypotheses = {slanted(1.0, 0.0), slanted(9.0, 0.0)};
  EXPECT_TRUE(scoreScan(result, {9.0, 2.01, 0.0}).in_ellipse);
  EXPECT_TRUE(scoreScan(result, {1.0, 2.01, 0.0}).in_ellipse);
  // Right within the tolerance, but surer than it may be; and the other way round.
  const ScanScore sure = scoreScan(result, {1.1, 1.9, 0.0});
  EXPECT_EQ(sure.right_rank, 1U);
  EXPECT_FALSE(sure.in_ellipse);
  const ScanScore strict = scoreScan(result, {1.1, 2.1, 0.0}, {0.05, 0.05});
  EXPECT_EQ(strict.right_rank, 0U);
  EXPECT_TRUE(strict.in_ellipse);
  EXPECT_FALSE(scoreScan(LocalizationResult{}, {1.0, 2.0, 0.0}).in_ellipse);
}

TEST(PercentileTest, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(percentile({3, 1, 2}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(percentile({10, 0}, 0.9), 9.0);
  EXPECT_DOUBLE_EQ(percentile({7}, 0.9), 7.0);
  EXPECT_DOUBLE_EQ(percentile({5, 9, 1}, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile({5, 9, 1}, 1.0), 9.0);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(PercentileTest, AgreesWithSortingOnRandomValues) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 100);
  for (std::size_t n = 1; n < 60; ++n) {
    std::vector<double> values(n);
    for (double& value : values) value = uniform(random);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    for (const double share : {0.0, 0.1, 0.5, 0.9, 0.99, 1.0}) {
      const double place = share * static_cast<double>(n - 1);
      const auto low = static_cast<std::size_t>(place);
      const std::size_t high = std::min(low + 1, n - 1);
      const double expected =
          sorted[low] + (place - static_cast<double>(low)) * (sorted[high] - sorted[low]);
      EXPECT_NEAR(percentile(values, share), expected, 1e-12) << n << " " << share;
    }
  }
}

TEST(SummarizeTest, CountsRanksAndStatuses) {
  using S = LocalizationStatus;
  const std::vector<ScanScore> scores{
      score(S::unique, 1, 0.1, 10),    score(S::unique, 0, 8.0, 20),
      score(S::ambiguous, 5, 3.0, 30), score(S::ambiguous, 6, 3.0, 40),
      score(S::ambiguous, 1, 0.3, 50), score(S::ambiguous, 21, 4.0, 60),
      score(S::no_match, 1, 0.0, 70),  score(S::too_few_beams, 0, std::nan(""), 0)};
  const Summary all = summarize(scores);
  EXPECT_EQ(all.scans, 8U);
  EXPECT_DOUBLE_EQ(all.top1, 2.0 / 8);
  EXPECT_DOUBLE_EQ(all.top5, 3.0 / 8);
  EXPECT_DOUBLE_EQ(all.top20, 4.0 / 8);
  EXPECT_DOUBLE_EQ(all.in_list, 5.0 / 8);
  EXPECT_DOUBLE_EQ(all.in_ellipse, 0.0);
  std::vector<ScanScore> within = scores;
  within[1].in_ellipse = within[2].in_ellipse = within[6].in_ellipse = true;
  EXPECT_DOUBLE_EQ(summarize(within).in_ellipse, 2.0 / 8);  // the last of them was withdrawn
  EXPECT_THAT(all.unique_right, Optional(0.5));
  ASSERT_TRUE(all.median_error_m && all.median_error_deg);
  EXPECT_NEAR(*all.median_error_m, 0.2, 1e-12);
  EXPECT_NEAR(*all.median_error_deg, 0.02 * 180 / M_PI, 1e-12);
  EXPECT_DOUBLE_EQ(all.ms_median, 35.0);
  EXPECT_DOUBLE_EQ(all.ms_p90, 63.0);
  EXPECT_DOUBLE_EQ(all.ms_max, 70.0);
  EXPECT_THAT(all.status, ElementsAre(2, 4, 1, 1));
}

TEST(SummarizeTest, TakesTheRowsThatAreNamed) {
  using S = LocalizationStatus;
  const std::vector<ScanScore> scores{score(S::unique, 1, 0.1, 1), score(S::ambiguous, 0, 9, 2),
                                      score(S::ambiguous, 2, 9, 3)};
  const std::vector<std::size_t> rows{2, 1};
  const Summary some = summarize(scores, &rows);
  EXPECT_EQ(some.scans, 2U);
  EXPECT_DOUBLE_EQ(some.top1, 0.0);
  EXPECT_DOUBLE_EQ(some.top5, 0.5);
  EXPECT_FALSE(some.unique_right.has_value());
  EXPECT_FALSE(some.median_error_m.has_value());
  const std::vector<std::size_t> beyond{3};
  EXPECT_THROW(summarize(scores, &beyond), std::out_of_range);
}

TEST(SummarizeTest, NothingIsZero) {
  const std::vector<std::size_t> none;
  const Summary empty = summarize({score(LocalizationStatus::unique, 1, 0, 1)}, &none);
  EXPECT_EQ(empty.scans, 0U);
  EXPECT_EQ(empty.top1, 0.0);
  EXPECT_EQ(empty.ms_max, 0.0);
  EXPECT_EQ(summarize({}).scans, 0U);
}

}  // namespace
}  // namespace mrpt_polyloc
