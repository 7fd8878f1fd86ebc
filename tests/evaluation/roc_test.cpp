#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/roc.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc::test {
namespace {

double countedShareBelow(const std::vector<double>& scores, double threshold) {
  const auto count =
      std::count_if(scores.begin(), scores.end(), [&](double score) { return score < threshold; });
  return static_cast<double>(count) / static_cast<double>(scores.size());
}

/// Scores on a coarse grid, so that there are many ties.
std::vector<double> tiedScores(Random& random, std::size_t count, double mean) {
  std::vector<double> scores(count);
  for (double& score : scores) score = std::round(4.0 * (mean + random.normal())) / 4.0;
  return scores;
}

TEST(RocCurve, EveryPointIsWhatCountingGives) {
  Random random(3);
  for (int round = 0; round < 20; ++round) {
    const auto truths = tiedScores(random, 1 + 3 * static_cast<std::size_t>(round), 1.0);
    const auto foreign = tiedScores(random, 40, 0.0);
    const auto curve = rocCurve(truths, foreign);
    EXPECT_EQ(curve.front().lost, 0.0);
    EXPECT_EQ(curve.front().refused, 0.0);
    EXPECT_EQ(curve.back().threshold, std::numeric_limits<double>::infinity());
    EXPECT_EQ(curve.back().lost, 1.0);
    EXPECT_EQ(curve.back().refused, 1.0);
    for (std::size_t i = 0; i < curve.size(); ++i) {
      EXPECT_EQ(curve[i].lost, countedShareBelow(truths, curve[i].threshold));
      EXPECT_EQ(curve[i].refused, countedShareBelow(foreign, curve[i].threshold));
      if (i > 0) {
        EXPECT_GT(curve[i].threshold, curve[i - 1].threshold);
      }
    }
  }
}

TEST(RocArea, IsTheShareOfPairsInOrder) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const auto truths = tiedScores(random, 37, 0.2 * round);
    const auto foreign = tiedScores(random, 23, 0.0);
    double pairs = 0.0;
    for (const double t : truths) {
      for (const double f : foreign) pairs += t > f ? 1.0 : t == f ? 0.5 : 0.0;
    }
    EXPECT_NEAR(rocArea(rocCurve(truths, foreign)), pairs / (37.0 * 23.0), 1e-12);
  }
}

TEST(PointAtLoss, IsTheBestThatLosesNoMore) {
  const std::vector<double> truths{1, 2, 3, 4}, foreign{0, 1.5, 2.5, 5};
  const auto curve = rocCurve(truths, foreign);
  EXPECT_EQ(pointAtLoss(curve, 0.0).refused, 0.25);
  EXPECT_EQ(pointAtLoss(curve, 0.24).refused, 0.25);
  EXPECT_EQ(pointAtLoss(curve, 0.25).refused, 0.5);
  EXPECT_EQ(pointAtLoss(curve, 0.25).threshold, 2.0);
  EXPECT_EQ(pointAtLoss(curve, 1.0).refused, 1.0);
}

TEST(RocCurve, RefusesWhatHasNoCurve) {
  EXPECT_THROW(rocCurve({}, {1.0}), InvalidParamsError);
  EXPECT_THROW(rocCurve({1.0}, {}), InvalidParamsError);
  EXPECT_THROW(rocCurve({1.0}, {std::nan("")}), InvalidParamsError);
}

}  // namespace
}  // namespace mrpt_polyloc::test
