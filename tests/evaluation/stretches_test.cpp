#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/evaluation/stretches.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc {
namespace {

using testing::ElementsAre;

TEST(Stretches, EndAfterTheirLengthAndAtJumps) {
  std::vector<mrpt::math::TPose2D> drive;
  for (const double x : {0.0, 1.0, 2.0, 2.9, 3.1, 4.1, 14.0, 14.5}) drive.emplace_back(x, 0, 0);
  EXPECT_THAT(stretchesOf(drive, {3.0, 2.0}), ElementsAre(0, 0, 0, 0, 1, 1, 2, 2));
  EXPECT_THAT(stretchesOf({}), ElementsAre());
}

TEST(Stretches, WayIsMeasuredAlongTheDrive) {
  std::vector<mrpt::math::TPose2D> drive;  // to and fro
  for (int i = 0; i < 9; ++i) drive.emplace_back(i % 2, 0, 0);
  EXPECT_THAT(stretchesOf(drive, {4.0, 2.0}), ElementsAre(0, 0, 0, 0, 1, 1, 1, 1, 2));
}

/// Values of `stretches` stretches of `length`; within one all are alike with this probability.
struct Sample {
  std::vector<bool> values;
  std::vector<std::size_t> stretch;
};
Sample draw(std::size_t stretches, std::size_t length, double share, double alike, Random& random) {
  Sample sample;
  for (std::size_t s = 0; s < stretches; ++s) {
    const bool of_stretch = random.unit() < share, together = random.unit() < alike;
    for (std::size_t i = 0; i < length; ++i) {
      sample.values.push_back(together ? of_stretch : random.unit() < share);
      sample.stretch.push_back(s);
    }
  }
  return sample;
}

TEST(ShareInterval, CoversTheTruthWhereNeighboursAreAlike) {
  // 95 % of the intervals must hold the true share; those over rows, as if scans were independent,
  // hold it far less often. That is what stretches are for.
  Random random(3);
  constexpr int kTrials = 300;
  int by_stretch = 0, by_row = 0;
  for (int k = 0; k < kTrials; ++k) {
    Sample sample = draw(60, 10, 0.7, 0.9, random);
    const auto holds = [](const ShareInterval& interval) {
      return interval.low <= 0.7 && 0.7 <= interval.high;
    };
    by_stretch += holds(shareInterval(sample.values, sample.stretch, 1, 400));
    for (std::size_t i = 0; i < sample.stretch.size(); ++i) sample.stretch[i] = i;
    by_row += holds(shareInterval(sample.values, sample.stretch, 1, 400));
  }
  EXPECT_GE(by_stretch, kTrials * 0.90);
  EXPECT_LE(by_row, kTrials * 0.70);
}

TEST(ShareInterval, OfIndependentScansIsTheNormalOneForMany) {
  Random random(5);
  const Sample sample = draw(2000, 1, 0.3, 0.0, random);
  const double share =
      static_cast<double>(std::count(sample.values.begin(), sample.values.end(), true)) / 2000;
  const double half = 1.96 * std::sqrt(share * (1 - share) / 2000);
  const ShareInterval interval = shareInterval(sample.values, sample.stretch);
  EXPECT_NEAR(interval.low, share - half, 0.1 * half);
  EXPECT_NEAR(interval.high, share + half, 0.1 * half);
}

TEST(ShareInterval, OfPerfectScansKnowsHowFewStretchesThereWere) {
  const std::vector<bool> right(100, true);
  std::vector<std::size_t> stretch(100);
  for (std::size_t i = 0; i < 100; ++i) stretch[i] = i / 10;
  // Clopper and Pearson for 10 of 10: 0.6915.
  EXPECT_NEAR(shareInterval(right, stretch).low, 0.6915, 1e-4);
  EXPECT_EQ(shareInterval(right, stretch).high, 1.0);
  EXPECT_NEAR(shareInterval(std::vector<bool>(100, false), stretch).high, 1 - 0.6915, 1e-4);
}

TEST(ShareInterval, IsDeterministicAndRefusesNonsense) {
  Random random(7);
  const Sample sample = draw(20, 5, 0.5, 0.5, random);
  EXPECT_EQ(shareInterval(sample.values, sample.stretch).low,
            shareInterval(sample.values, sample.stretch).low);
  EXPECT_EQ(shareInterval({}, {}).high, 1.0);
  EXPECT_EQ(shareInterval({}, {}).low, 0.0);
  EXPECT_THROW(shareInterval({true}, {}), InvalidParamsError);
  EXPECT_THROW(differenceInterval({true}, {}, {0}), InvalidParamsError);
}

TEST(DifferenceInterval, IsPairedAndNarrowWhereMethodsFailTogether) {
  Random random(9);
  const Sample sample = draw(200, 5, 0.5, 1.0, random);
  std::vector<bool> better = sample.values;
  std::size_t gained = 0;
  for (std::size_t i = 0; i < better.size(); i += 10) {
    gained += better[i] ? 0 : 1;
    better[i] = true;
  }
  const double difference = static_cast<double>(gained) / 1000.0;
  const ShareInterval paired = differenceInterval(better, sample.values, sample.stretch);
  EXPECT_LT(paired.low, difference);
  EXPECT_GT(paired.high, difference);
  EXPECT_GT(paired.low, 0.0);  // it is better, though each share alone is known to 7 points only
  const ShareInterval same = differenceInterval(better, better, sample.stretch);
  EXPECT_LT(same.low, 0.0);
  EXPECT_GT(same.high, 0.0);
  EXPECT_LT(same.high, 0.02);
}

}  // namespace
}  // namespace mrpt_polyloc
