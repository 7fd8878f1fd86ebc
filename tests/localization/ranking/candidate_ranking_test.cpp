#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

class CandidateRanking : public ::testing::Test {
 protected:
  Assessment rank(const std::vector<TPose2D>& candidates, const PosePrior& prior = {},
                  const RankingParams& params = {}) const {
    const AllowedPoses allowed(triangulation_, prior, scan_.sensor());
    return rankCandidates(candidates, scan_, allowed, predictor_, params);
  }

  PolygonMap map_ = asymmetricRoom();
  TPose2D truth_{1.52, 2.13, 0.3};
  RangeScan scan_ = simulatedScan(map_, truth_);
  Triangulation triangulation_{map_};
  RangePredictor predictor_{triangulation_, RangePredictor::kSquareSize, 1};
  /// Near the truth from two sides, and elsewhere.
  std::vector<TPose2D> candidates_ = {
      {6.2, 1.0, 2.0}, {1.6, 2.2, 0.35}, {1.4, 2.0, 0.25}, {3.0, 4.5, 1.0}, {4.5, 1.0, -1.0}};
};

TEST_F(CandidateRanking, RefinesMergesAndRanks) {
  const auto result = rank(candidates_);
  EXPECT_EQ(result.status, LocalizationStatus::unique);
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_LT(distanceBetween(result.hypotheses[0].pose_map_robot, truth_), 0.01);
  for (std::size_t i = 1; i < result.hypotheses.size(); ++i) {
    EXPECT_GE(result.hypotheses[i].z_score, result.hypotheses[i - 1].z_score);
    EXPECT_GT(distanceBetween(result.hypotheses[i].pose_map_robot, truth_), 0.2);  // merged
  }
}

TEST_F(CandidateRanking, DoesNotDependOnTheOrder) {
  const auto forwards = rank(candidates_);
  std::reverse(candidates_.begin(), candidates_.end());
  const auto backwards = rank(candidates_);
  ASSERT_EQ(forwards.hypotheses.size(), backwards.hypotheses.size());
  for (std::size_t i = 0; i < forwards.hypotheses.size(); ++i) {
    const Hypothesis &a = forwards.hypotheses[i], &b = backwards.hypotheses[i];
    EXPECT_LT(distanceBetween(a.pose_map_robot, b.pose_map_robot), 1e-3) << i;
    EXPECT_NEAR(a.weight, b.weight, 1e-3) << i;
  }
}

TEST_F(CandidateRanking, OfNoGoodCandidateIsNoMatch) {
  EXPECT_EQ(rank({}).status, LocalizationStatus::no_match);
  EXPECT_EQ(rank({{3.0, 4.5, 1.0}}).status, LocalizationStatus::no_match);
  EXPECT_NE(rank({{6.2, 1.0, 2.0}}).status, LocalizationStatus::unique);  // half of it fits
}

TEST_F(CandidateRanking, ThePriorHolds) {
  PosePrior prior;
  prior.compass = PosePrior::Compass{truth_.phi + 1.5, 0.2};
  const Assessment turned = rank({truth_}, prior);
  EXPECT_NE(turned.status, LocalizationStatus::unique);
  for (const Hypothesis& h : turned.hypotheses) {
    EXPECT_LE(angleBetween(h.pose_map_robot.phi, truth_.phi + 1.5), 0.2 + 1e-6);
  }
  prior.compass->heading = truth_.phi + 0.1;
  EXPECT_EQ(rank({truth_}, prior).status, LocalizationStatus::unique);
  prior.near = PosePrior::Disk{5.0, 1.0, 1.0};
  EXPECT_NE(rank({truth_}, prior).status, LocalizationStatus::unique);
}

TEST_F(CandidateRanking, ReturnsNoMoreThanAskedForAndKnowsOfRivalsAllTheSame) {
  // A square room looks the same from four poses.
  const PolygonMap square = squareMap(6.0);
  const Triangulation triangulation(square);
  const RangePredictor predictor{triangulation, RangePredictor::kSquareSize, 1};
  const RangeScan scan = simulatedScan(square, {1.5, 2.2, 0.4});
  RankingParams params;
  params.max_hypotheses = 1;
  const PosePrior anywhere;
  const auto result = rankCandidates({{1.5, 2.2, 0.4}, {3.8, 1.5, 0.4 + kPi / 2}}, scan,
                                     {triangulation, anywhere, scan.sensor()}, predictor, params);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  EXPECT_EQ(result.hypotheses.size(), 1U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
