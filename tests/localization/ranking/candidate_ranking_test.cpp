#include "tests/support/simulated_scans.h"
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
    return rankCandidates(candidates, scan_, prior, predictor_, params);
  }

  PolygonMap map_ = asymmetricRoom();
  TPose2D truth_{1.52, 2.13, 0.3};
  RangeScan scan_ = simulatedScan(map_, truth_);
  RangePredictor predictor_{Triangulation(map_), RangePredictor::kSquareSize, 1};
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
    EXPECT_GE(result.hypotheses[i].cost, result.hypotheses[i - 1].cost);
    EXPECT_GT(distanceBetween(result.hypotheses[i].pose_map_robot, truth_), 0.2);  // merged
  }
}

TEST_F(CandidateRanking, DoesNotDependOnTheOrder) {
  const auto forwards = rank(candidates_);
  std::reverse(candidates_.begin(), candidates_.end());
  const auto backwards = rank(candidates_);
  ASSERT_EQ(forwards.hypotheses.size(), backwards.hypotheses.size());
  EXPECT_LT(distanceBetween(forwards.hypotheses[0].pose_map_robot,
                            backwards.hypotheses[0].pose_map_robot),
            1e-3);
}

TEST_F(CandidateRanking, OfNoGoodCandidateIsNoMatch) {
  EXPECT_EQ(rank({}).status, LocalizationStatus::no_match);
  EXPECT_EQ(rank({{3.0, 4.5, 1.0}}).status, LocalizationStatus::no_match);
  EXPECT_NE(rank({{6.2, 1.0, 2.0}}).status, LocalizationStatus::unique);  // half of it fits
  PosePrior prior;
  prior.compass = PosePrior::Compass{truth_.phi + 1.5, 0.2};
  EXPECT_EQ(rank({truth_}, prior).status, LocalizationStatus::no_match);
  prior.compass->heading = truth_.phi + 0.1;
  EXPECT_EQ(rank({truth_}, prior).status, LocalizationStatus::unique);
  prior.near = PosePrior::Disk{5.0, 1.0, 1.0};
  EXPECT_EQ(rank({truth_}, prior).status, LocalizationStatus::no_match);
}

TEST_F(CandidateRanking, ReturnsNoMoreThanAskedForAndKnowsOfRivalsAllTheSame) {
  // A square room looks the same from four poses.
  const PolygonMap square = squareMap(6.0);
  const RangePredictor predictor{Triangulation(square), RangePredictor::kSquareSize, 1};
  const RangeScan scan = simulatedScan(square, {1.5, 2.2, 0.4});
  RankingParams params;
  params.max_hypotheses = 1;
  const auto result =
      rankCandidates({{1.5, 2.2, 0.4}, {3.8, 1.5, 0.4 + kPi / 2}}, scan, {}, predictor, params);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  EXPECT_EQ(result.hypotheses.size(), 1U);
}

}  // namespace
}  // namespace mrpt_polyloc::test
