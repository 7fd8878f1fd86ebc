#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/ranking/assess.h>
#include <mrpt_polyloc/localization/ranking/match_features.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

class Assess : public ::testing::Test {
 protected:
  ScoredPose at(const TPose2D& pose) const {
    const PoseRefiner refiner(predictor_, scan_, still());
    return {refiner.refine(pose), cost_.mean(pose)};
  }
  /// Information, but no step away from the pose.
  static PoseRefinerParams still() {
    PoseRefinerParams params;
    params.max_iterations = 0;
    return params;
  }
  Assessment assessed(const std::vector<ScoredPose>& poses, const Calibration& calibration,
                      std::size_t max_hypotheses = 20) const {
    HypothesisParams params;
    params.calibration = calibration;
    return assess(poses, scan_, cost_, params, max_hypotheses);
  }
  /// Every scan matches.
  static Calibration trusting() {
    Calibration calibration;
    calibration.match_intercept = 100.0;
    calibration.match_weights.fill(0.0);
    calibration.weight_decay = 1.0;
    calibration.unique_probability = 0.9;
    return calibration;
  }

  PolygonMap map_ = squareMap(5.0);
  RangePredictor predictor_{Triangulation(map_), RangePredictor::kSquareSize, 1};
  TPose2D truth_{1.5, 2, 0.3}, twin_{3.5, 3, 0.3 + kPi}, wrong_{3.5, 2, 0.3};
  RangeScan scan_ = simulatedScan(map_, truth_);
  ScanCost cost_{predictor_, scan_, {}};
};

TEST_F(Assess, ATwinIsARivalWhereverItStands) {
  EXPECT_EQ(assessed({at(truth_)}, trusting()).status, LocalizationStatus::unique);
  EXPECT_EQ(assessed({at(truth_), at(wrong_)}, trusting()).status, LocalizationStatus::unique);
  EXPECT_EQ(assessed({at(truth_), at(twin_)}, trusting()).status, LocalizationStatus::ambiguous);
  EXPECT_EQ(assessed({at(truth_), at(wrong_), at(twin_)}, trusting()).status,
            LocalizationStatus::ambiguous);
}

TEST_F(Assess, ItStaysAmbiguousIfOnlyOneIsAskedFor) {
  const auto result = assessed({at(truth_), at(twin_)}, trusting(), 1);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  ASSERT_EQ(result.hypotheses.size(), 1U);
  EXPECT_NEAR(result.hypotheses[0].weight, 0.5, 0.1);  // of both
  EXPECT_EQ(result.listed, result.hypotheses[0].weight);
}

TEST_F(Assess, ANicheOfAFewBeamsIsNotSure) {
  // Only a niche, seen by some four of 360 beams, tells the pose from its twin.
  const PolygonMap map =
      mapOf({{0, 0}, {5, 0}, {5, 2}, {5.4, 2}, {5.4, 2.2}, {5, 2.2}, {5, 5}, {0, 5}});
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const TPose2D truth(1.5, 2.1, 0.3), twin(3.5, 2.9, 0.3 + kPi);
  const RangeScan scan = simulatedScan(map, truth);
  const ScanCost cost(predictor, scan, {});
  HypothesisParams params;
  params.calibration = trusting();
  ScoredPose first{{truth, {}, 360}, cost.mean(truth)}, second{{twin, {}, 360}, cost.mean(twin)};
  first.refined.information.setIdentity();
  second.refined.information.setIdentity();
  ASSERT_GT(second.cost - first.cost, 1e-3);
  EXPECT_EQ(assess({first, second}, scan, cost, params, 20).status, LocalizationStatus::ambiguous);
  params.evidence.off_wall_cost = 0.0;  // where points lie counts by the space that they take
  const Assessment result = assess({first, second}, scan, cost, params, 20);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  EXPECT_LT(result.hypotheses[1].z_score, 1.5);  // one sector of 36
}

TEST_F(Assess, RefusedBelowTheLeastProbability) {
  Calibration calibration = trusting();
  calibration.match_intercept = 0.0;  // probability one half
  calibration.least_match_probability = 0.51;
  const auto refused = assessed({at(truth_)}, calibration);
  EXPECT_EQ(refused.status, LocalizationStatus::no_match);
  EXPECT_TRUE(refused.hypotheses.empty());
  EXPECT_EQ(refused.match_probability, 0.5);
  EXPECT_TRUE(refused.features.has_value());
  calibration.least_match_probability = 0.5;
  // Sure to be the first if any, but only one half that there is any.
  EXPECT_EQ(assessed({at(truth_)}, calibration).status, LocalizationStatus::ambiguous);
  calibration.unique_probability = 0.5;
  EXPECT_EQ(assessed({at(truth_)}, calibration).status, LocalizationStatus::unique);
}

TEST_F(Assess, NothingFoundIsNoMatch) {
  const Assessment result = assess({}, scan_, cost_, {}, 20);
  EXPECT_EQ(result.status, LocalizationStatus::no_match);
  EXPECT_TRUE(result.hypotheses.empty());
  EXPECT_FALSE(result.features.has_value());
  EXPECT_EQ(result.match_probability, 0.0);
}

TEST_F(Assess, FeaturesOfThePerfectAnswer) {
  const MatchFeatures features = *assessed({at(truth_), at(wrong_)}, trusting()).features;
  EXPECT_EQ(features.explained, 1.0);
  EXPECT_NEAR(features.seen, 1.0, 1e-6);
  EXPECT_EQ(features.lead, 1.0);
  EXPECT_LT(features.heading, std::log(0.05));
  const MatchFeatures with_twin = *assessed({at(truth_), at(twin_)}, trusting()).features;
  EXPECT_NEAR(with_twin.lead, 0.0, 1e-3);
}

}  // namespace
}  // namespace mrpt_polyloc::test
