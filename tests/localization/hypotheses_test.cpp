#include "params_messages.h"
#include "simulated_scans.h"
#include <mrpt_polyloc/localization/hypotheses.h>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

RankedPose ranked(const TPose2D& pose, double cost, double information = 1000.0) {
  RankedPose result;
  result.refined.pose_map_beams = pose;
  result.refined.information.setZero();
  for (int i = 0; i < 3; ++i) result.refined.information(i, i) = information;
  result.cost = cost;
  return result;
}

std::vector<double> costsOf(const std::vector<RankedPose>& poses) {
  std::vector<double> costs;
  for (const RankedPose& pose : poses) costs.push_back(pose.cost);
  return costs;
}

TEST(MergeNearPoses, KeepsTheBestOfPosesThatAreNearlyOne) {
  const auto merged =
      mergeNearPoses({ranked({1.1, 1, 0}, 0.3), ranked({1, 1, 0}, 0.1), ranked({5, 1, 0}, 0.2),
                      ranked({1, 1.15, 0.03}, 0.15), ranked({1, 1, 0.2}, 0.4)});
  EXPECT_EQ(costsOf(merged), (std::vector<double>{0.1, 0.2, 0.4}));
}

TEST(MergeNearPoses, HeadingsAreOnACircle) {
  EXPECT_EQ(mergeNearPoses({ranked({1, 1, 3.13}, 0.1), ranked({1, 1, -3.13}, 0.2)}).size(), 1U);
  EXPECT_EQ(mergeNearPoses({ranked({1, 1, 0.0}, 0.1), ranked({1, 1, 4 * kPi}, 0.2)}).size(), 1U);
  EXPECT_EQ(mergeNearPoses({ranked({1, 1, 0.0}, 0.1), ranked({1, 1, kPi}, 0.2)}).size(), 2U);
}

TEST(MergeNearPoses, BoundsOfDistanceAndAngle) {
  HypothesisParams params;
  params.merge_distance = 0.5;
  params.merge_angle = 0.25;
  const auto count = [&](const TPose2D& other) {
    return mergeNearPoses({ranked({0, 0, 0}, 0.1), ranked(other, 0.2)}, params).size();
  };
  EXPECT_EQ(count({0.49, 0, 0.24}), 1U);
  EXPECT_EQ(count({0.51, 0, 0}), 2U);
  EXPECT_EQ(count({0, 0, 0.26}), 2U);
  EXPECT_TRUE(mergeNearPoses({}).empty());
}

TEST(MergeNearPoses, OfEqualCostsTheFirstStaysFirst) {
  const auto merged = mergeNearPoses({ranked({1, 0, 0}, 0.1), ranked({2, 0, 0}, 0.1)});
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0].refined.pose_map_beams.x, 1.0);
}

RangeScan manyBeams(const TPoint2D& sensor = {0, 0}) {
  return simulatedScan(asymmetricRoom(), {1.5, 2, 0.3}, {360, 2 * kPi, 80.0, sensor});
}

TEST(ToHypotheses, WeightsSumToOneAndFallWithTheCost) {
  const auto hypotheses = toHypotheses({ranked({1, 1, 0}, 0.1), ranked({5, 1, 0}, 0.1),
                                        ranked({1, 2, 0}, 0.12), ranked({1, 3, 0}, 0.2)},
                                       manyBeams());
  ASSERT_EQ(hypotheses.size(), 4U);
  double sum = 0.0;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    sum += hypotheses[i].weight;
    EXPECT_GT(hypotheses[i].weight, 0.0);
    if (i > 0) {
      EXPECT_LE(hypotheses[i].weight, hypotheses[i - 1].weight);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(hypotheses[0].weight, hypotheses[1].weight);
  // 36 blocks of beams, each of which tells by 0.02 m in units of 0.25 m.
  EXPECT_NEAR(hypotheses[2].weight / hypotheses[0].weight, std::exp(-0.02 * 36 / 0.25), 1e-9);
  EXPECT_EQ(hypotheses[2].cost, 0.12);
  EXPECT_TRUE(toHypotheses({}, manyBeams()).empty());
  EXPECT_EQ(toHypotheses({ranked({1, 1, 0}, 0.9)}, manyBeams())[0].weight, 1.0);
}

TEST(ToHypotheses, PoseIsTheRobots) {
  const RangeScan scan = manyBeams({0.4, -0.2});
  const TPose2D beams(3, 4, 1.2);
  const auto hypothesis = toHypotheses({ranked(beams, 0.1)}, scan)[0];
  EXPECT_LT(distanceBetween(scan.beamFrameFromRobot(hypothesis.pose_map_robot), beams), 1e-12);
}

Eigen::Matrix3d covarianceOf(const Hypothesis& hypothesis) {
  Eigen::Matrix3d m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m(row, column) = hypothesis.covariance(row, column);
  }
  return m;
}

TEST(ToHypotheses, CovarianceIsThatOfPosesDrawnForTheSensorAndMovedToTheRobot) {
  const RangeScan scan = manyBeams({0.8, 0.5});
  const TPose2D beams(3, 4, 0.9);
  Eigen::Matrix3d factor;
  factor << 40, 0, 0, -10, 60, 0, 12, 5, 150;
  const Eigen::Matrix3d information = factor * factor.transpose();
  RankedPose pose = ranked(beams, 0.1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      pose.refined.information(row, column) = information(row, column);
    }
  }
  HypothesisParams params;
  params.beams_per_block = 1;
  const Eigen::Matrix3d covariance = covarianceOf(toHypotheses({pose}, scan, params)[0]);

  // A hypothesis is local: 0.5 m and 10 degrees are known beforehand.
  const Eigen::Vector3d local(4, 4, std::pow(0.1745, -2));
  const Eigen::Matrix3d with_local = information + Eigen::Matrix3d(local.asDiagonal());
  const Eigen::Matrix3d of_sensor = with_local.inverse();
  const Eigen::Matrix3d root = of_sensor.llt().matrixL();
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 100000;
  const TPose2D center = scan.robotFromBeamFrame(beams);
  Eigen::Matrix3d sampled = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d error =
        root * Eigen::Vector3d(normal(random), normal(random), normal(random));
    const TPose2D robot =
        scan.robotFromBeamFrame({beams.x + error[0], beams.y + error[1], beams.phi + error[2]});
    const Eigen::Vector3d moved(robot.x - center.x, robot.y - center.y, robot.phi - center.phi);
    sampled += moved * moved.transpose() / kDraws;
  }
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double scale = std::sqrt(sampled(row, row) * sampled(column, column));
      EXPECT_NEAR(covariance(row, column), sampled(row, column), 0.02 * scale);
    }
  }
}

TEST(ToHypotheses, CovarianceIsPositiveDefiniteEvenWhereTheScanHoldsNothing) {
  for (const double information : {0.0, 1e-3, 1.0, 1e8}) {
    RankedPose pose = ranked({1, 2, 0.3}, 0.1, information);
    pose.refined.information(0, 0) = 0.0;
    const Eigen::Matrix3d covariance = covarianceOf(toHypotheses({pose}, manyBeams({2, 1}))[0]);
    EXPECT_LT((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(Eigen::LLT<Eigen::Matrix3d>(covariance).info(), Eigen::Success);
    EXPECT_GT(covariance.eigenvalues().real().minCoeff(), 0.0);
  }
}

TEST(ToHypotheses, NeighbouringBeamsInformOnce) {
  HypothesisParams one, ten;
  one.beams_per_block = 1;
  ten.beams_per_block = 10;
  const std::vector<RankedPose> poses{ranked({1, 2, 0.3}, 0.1, 1e9)};
  const double ratio = toHypotheses(poses, manyBeams(), ten)[0].covariance(0, 0) /
                       toHypotheses(poses, manyBeams(), one)[0].covariance(0, 0);
  EXPECT_NEAR(ratio, 10.0, 0.01);
}

class RivalTest : public ::testing::Test {
 protected:
  /// Ranked as the localizer would.
  RankedPose at(const TPose2D& pose) const { return ranked(pose, cost_.mean(pose)); }

  PolygonMap map_ = squareMap(5.0);
  RangePredictor predictor_{Triangulation(map_), RangePredictor::kCellSize, 1};
  TPose2D truth_{1.5, 2, 0.3};
  RangeScan scan_ = simulatedScan(map_, truth_);
  ScanCost cost_{predictor_, scan_, {}};
};

TEST_F(RivalTest, ATwinIsARival) {
  const TPose2D twin(3.5, 3, 0.3 + kPi);  // half a turn about the middle
  EXPECT_LT(cost_.mean(twin), 1e-4);
  EXPECT_FALSE(isUnique({at(truth_), at(twin)}, cost_));
}

TEST_F(RivalTest, AClearlyWorsePoseIsNone) {
  EXPECT_TRUE(isUnique({at(truth_), at({3.5, 2, 0.3})}, cost_));
  EXPECT_TRUE(isUnique({at(truth_)}, cost_));
}

TEST_F(RivalTest, ATwinAmongOthersIsFoundWhereverItStands) {
  EXPECT_FALSE(isUnique({at(truth_), at({3.5, 2, 0.3}), at({3.5, 3, 0.3 + kPi})}, cost_));
}

TEST_F(RivalTest, DifferencesBelowTheRivalCostDoNotCount) {
  const TPose2D near_by(1.52, 2, 0.3);  // stands for a slightly worse fit
  const double difference = cost_.mean(near_by) - cost_.mean(truth_);
  ASSERT_GT(difference, 0.005);
  HypothesisParams params;
  params.rival_deviations = 0.0;
  params.rival_cost = 0.9 * difference;
  EXPECT_TRUE(isUnique({at(truth_), at(near_by)}, cost_, params));
  params.rival_cost = 1.1 * difference;
  EXPECT_FALSE(isUnique({at(truth_), at(near_by)}, cost_, params));
}

TEST(IsUnique, ADifferenceOfAFewNeighbouringBeamsIsNotSure) {
  // Only a niche, seen by some four of 360 beams, tells the pose from its twin.
  const PolygonMap map =
      mapOf({{0, 0}, {5, 0}, {5, 2}, {5.4, 2}, {5.4, 2.2}, {5, 2.2}, {5, 5}, {0, 5}});
  const RangePredictor predictor(Triangulation(map), RangePredictor::kCellSize, 1);
  const TPose2D truth(1.5, 2.1, 0.3), twin(3.5, 2.9, 0.3 + kPi);
  const ScanCost cost(predictor, simulatedScan(map, truth), {});
  const double difference = cost.mean(twin) - cost.mean(truth);
  ASSERT_GT(difference, 1e-3);
  const std::vector<RankedPose> poses{ranked(truth, cost.mean(truth)),
                                      ranked(twin, cost.mean(twin))};
  HypothesisParams params;
  params.rival_cost = 0.5 * difference;
  EXPECT_FALSE(isUnique(poses, cost, params));
  params.rival_deviations = 0.5;
  EXPECT_TRUE(isUnique(poses, cost, params));
  params.beams_per_block = 1;  // beams on their own say more
  params.rival_deviations = 1.5;
  EXPECT_TRUE(isUnique(poses, cost, params));
}

TEST_F(RivalTest, OfNoPosesNoneIsUnique) {
  EXPECT_FALSE(isUnique({}, cost_));
}

TEST(HypothesisParams, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(HypothesisParams{}), "");
  const auto expectNamed = [](double HypothesisParams::*field, const std::string& name) {
    for (const double bad : {-1.0, std::nan("")}) {
      HypothesisParams params;
      params.*field = bad;
      EXPECT_THAT(complaintOf(params), HasSubstr(name));
    }
  };
  expectNamed(&HypothesisParams::merge_distance, "merge_distance");
  expectNamed(&HypothesisParams::merge_angle, "merge_angle");
  expectNamed(&HypothesisParams::no_match_cost, "no_match_cost");
  expectNamed(&HypothesisParams::rival_cost, "rival_cost");
  expectNamed(&HypothesisParams::rival_deviations, "rival_deviations");
  expectNamed(&HypothesisParams::weight_scale, "weight_scale");
  HypothesisParams params;
  params.beams_per_block = 0;
  EXPECT_THAT(complaintOf(params), HasSubstr("beams_per_block"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
