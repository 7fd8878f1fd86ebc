#include <mrpt_polyloc/evaluation/calibration_samples.h>

#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

LocalizationResult resultOf(const std::vector<TPose2D>& poses) {
  LocalizationResult result;
  result.features = MatchFeatures{0.9, 0.5, -4.0, 0.8};
  for (const TPose2D& pose : poses) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = pose;
    hypothesis.covariance.setZero();
    hypothesis.covariance(0, 0) = 0.01;
    hypothesis.covariance(1, 1) = 0.04;
    hypothesis.covariance(2, 2) = 0.0025;
    hypothesis.z_score = static_cast<double>(result.hypotheses.size());
    result.hypotheses.push_back(hypothesis);
  }
  return result;
}

TEST(CalibrationSample, TellsRightFromWrong) {
  const TPose2D truth(1, 2, 3.13);
  const auto sample =
      calibrationSample(resultOf({{1, 2.5, 3.13}, {1.1, 2.1, -3.13}, {1, 2, 0}}), &truth);
  ASSERT_TRUE(sample.has_value());
  ASSERT_EQ(sample->candidates.size(), 3U);
  EXPECT_FALSE(sample->candidates[0].right);
  EXPECT_TRUE(sample->candidates[1].right);
  EXPECT_FALSE(sample->candidates[2].right);
  EXPECT_EQ(sample->candidates[2].z_score, 2.0);
  EXPECT_EQ(sample->features.seen, 0.8);
  EXPECT_FALSE(sample->position_square.has_value());
}

TEST(CalibrationSample, SquaresOfTheErrorsByTheCovariance) {
  const TPose2D truth(1, 2, 3.13);
  const auto sample = calibrationSample(resultOf({{1.1, 1.8, -3.13}}), &truth);
  ASSERT_TRUE(sample && sample->position_square && sample->heading_square);
  EXPECT_NEAR(*sample->position_square, 0.1 * 0.1 / 0.01 + 0.2 * 0.2 / 0.04, 1e-9);
  const double turn = 2 * (3.14159265358979 - 3.13);
  EXPECT_NEAR(*sample->heading_square, turn * turn / 0.0025, 1e-9);
}

TEST(CalibrationSample, ForeignScansHaveNothingRight) {
  const auto sample = calibrationSample(resultOf({{1, 2, 3}}), nullptr);
  ASSERT_TRUE(sample.has_value());
  EXPECT_FALSE(sample->candidates[0].right);
  EXPECT_FALSE(sample->position_square.has_value());
  EXPECT_FALSE(calibrationSample(resultOf({}), nullptr).has_value());
}

TEST(Uncalibrated, RefusesNothingAndCorrectsNothing) {
  EXPECT_EQ(uncalibrated().least_match_probability, 0.0);
  EXPECT_EQ(uncalibrated().position_factor, 1.0);
  EXPECT_EQ(uncalibrated().heading_factor, 1.0);
}

}  // namespace
}  // namespace mrpt_polyloc::test
