#include "tests/support/params_messages.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/localization/ranking/hypotheses.h>
#include <mrpt_polyloc/localization/scan/BeamEvidence.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

ScoredPose ranked(const TPose2D& pose, double cost, double information = 1000.0) {
  ScoredPose result;
  result.refined.pose_map_beams = pose;
  result.refined.information.setZero();
  for (int i = 0; i < 3; ++i) result.refined.information(i, i) = information;
  result.cost = cost;
  return result;
}

std::vector<double> costsOf(const std::vector<ScoredPose>& poses) {
  std::vector<double> costs;
  for (const ScoredPose& pose : poses) costs.push_back(pose.cost);
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

/// A square room, seen from a place where its four quarter turns look alike.
class InASquare : public ::testing::Test {
 protected:
  /// Ranked as the localizer would.
  ScoredPose at(const TPose2D& pose) const { return ranked(pose, cost_.mean(pose)); }
  std::vector<Hypothesis> hypothesesOf(const std::vector<ScoredPose>& poses,
                                       const HypothesisParams& params = {}) const {
    return toHypotheses(poses, scan_, cost_, params);
  }

  PolygonMap map_ = squareMap(5.0);
  RangePredictor predictor_{Triangulation(map_), RangePredictor::kSquareSize, 1};
  TPose2D truth_{1.5, 2, 0.3}, twin_{3.5, 3, 0.3 + kPi}, wrong_{3.5, 2, 0.3};
  RangeScan scan_ = simulatedScan(map_, truth_, {360, 2 * kPi, 80.0, {0, 0}, 0.02});
  ScanCost cost_{predictor_, scan_, {}};
};

TEST_F(InASquare, WeightsAreTheSoftmaxOfTheErrorsBehind) {
  HypothesisParams params;
  params.calibration.weight_decay = 0.3;
  const auto hypotheses = hypothesesOf({at(truth_), at(twin_), at(wrong_)}, params);
  ASSERT_EQ(hypotheses.size(), 3U);
  EXPECT_EQ(hypotheses[0].z_score, 0.0);
  double sum = 0.0;
  for (const Hypothesis& hypothesis : hypotheses) sum += hypothesis.weight;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  for (std::size_t i = 1; i < hypotheses.size(); ++i) {
    EXPECT_GE(hypotheses[i].z_score, hypotheses[i - 1].z_score);
    EXPECT_NEAR(hypotheses[i].weight / hypotheses[0].weight, std::exp(-0.3 * hypotheses[i].z_score),
                1e-12);
  }
  EXPECT_LT(hypotheses[1].z_score, 2.0);  // the twin
  EXPECT_GT(hypotheses[2].z_score, 5.0);
}

TEST_F(InASquare, ErrorsBehindAreThoseOfTheEvidenceBySectors) {
  // The same, from the definition: sums over the 36 sectors of ten degrees.
  const auto evidence = [&](const TPose2D& pose) { return BeamEvidence(cost_).at(pose); };
  const auto best = evidence(truth_), other = evidence(wrong_);
  std::vector<std::vector<double>> sectors(36);
  double mean = 0.0;
  for (std::size_t i = 0; i < best.size(); ++i) {
    const double degrees = cost_.beams()[i].bearing * 180.0 / kPi + 180.0;
    const double difference = static_cast<double>(other[i]) - static_cast<double>(best[i]);
    sectors.at(static_cast<std::size_t>(degrees / 10.0)).push_back(difference);
    mean += difference / static_cast<double>(best.size());
  }
  std::vector<double> means;
  for (const auto& sector : sectors) {
    means.push_back(std::accumulate(sector.begin(), sector.end(), 0.0) /
                    static_cast<double>(sector.size()));
  }
  const double middle = std::accumulate(means.begin(), means.end(), 0.0) / 36.0;
  double squares = 0.0;
  for (const double m : means) squares += (m - middle) * (m - middle);
  const double error = std::sqrt(squares / 35.0 / 36.0);
  const auto hypotheses = hypothesesOf({at(truth_), at(wrong_)});
  EXPECT_NEAR(hypotheses[1].z_score, mean / std::hypot(error, HypothesisParams{}.indifference),
              1e-6 * hypotheses[1].z_score);
  // The same on a map of cells, of which walls are known no better.
  HypothesisParams coarse;
  coarse.cell_size = 0.2;
  coarse.cell_share = 0.5;
  const auto less_sure = hypothesesOf({at(truth_), at(wrong_)}, coarse);
  EXPECT_NEAR(less_sure[1].z_score,
              mean / std::sqrt(error * error + std::pow(coarse.indifference, 2) + 0.1 * 0.1),
              1e-6 * hypotheses[1].z_score);
}

TEST(HypothesisParams, TheCellSizeIsTheMapsUnlessOneIsGiven) {
  const std::vector<FreePolygon> components = squareMap(5.0).components();
  EXPECT_EQ(HypothesisParams{}.of(PolygonMap(components)).cell_size, 0.0);
  const PolygonMap traced(components, {}, 0.1);
  EXPECT_EQ(HypothesisParams{}.of(traced).cell_size, 0.1);
  HypothesisParams params;
  params.cell_size = 0.25;
  EXPECT_EQ(params.of(traced).cell_size, 0.25);
  // And with it what of each difference of ranges is the map's.
  EXPECT_EQ(HypothesisParams{}.of(PolygonMap(components)).evidence.tolerance, 0.0);
  EXPECT_EQ(HypothesisParams{}.of(PolygonMap(components, {}, 0.05)).evidence.tolerance, 0.0);
  params.tolerance_share = 0.5;
  EXPECT_NEAR(params.of(traced).evidence.tolerance, 0.5 * std::sqrt(0.25 * 0.25 - 0.05 * 0.05),
              1e-12);
  params.evidence.tolerance = 0.03;
  EXPECT_EQ(params.of(traced).evidence.tolerance, 0.03);
}

TEST_F(InASquare, PosesInMapsOfLargeCellsAreKnownTheWorse) {
  HypothesisParams params;
  const auto covariance = [&] { return hypothesesOf({at(truth_)}, params)[0].covariance; };
  const auto drawn = covariance();
  params.cell_size = 0.05;  // what the calibration was fitted on
  EXPECT_EQ(covariance(), drawn);
  params.cell_size = 0.25;
  params.position_share = 0.5;
  params.heading_share = 0.1;
  const auto coarse = covariance();
  const double more = 0.25 * 0.25 - 0.05 * 0.05;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double share = row != column ? 0.0 : row < 2 ? 0.5 * 0.5 : 0.1 * 0.1;
      EXPECT_NEAR(coarse(row, column), drawn(row, column) + share * more, 1e-12);
    }
  }
}

TEST_F(InASquare, RankedByTheEvidenceWhateverTheOrder) {
  const auto hypotheses = hypothesesOf({at(wrong_), at(truth_)});
  EXPECT_LT(distanceBetween(hypotheses[0].pose_map_robot, truth_), 1e-9);
  std::vector<std::size_t> order;
  toHypotheses({at(wrong_), at(truth_)}, scan_, cost_, {}, &order);
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(hypotheses[0].cost, cost_.mean(truth_));
  EXPECT_EQ(hypotheses[1].cost, cost_.mean(wrong_));
}

TEST_F(InASquare, OneIsCertainAndNoneGivesNone) {
  EXPECT_EQ(hypothesesOf({at(wrong_)})[0].weight, 1.0);
  EXPECT_TRUE(hypothesesOf({}).empty());
}

TEST_F(InASquare, FinerSensorsSayNoMore) {
  // Four times as many beams see the same walls: the same number of standard errors.
  const RangeScan fine = simulatedScan(map_, truth_, {1440, 2 * kPi, 80.0});
  const RangeScan coarse = simulatedScan(map_, truth_, {360, 2 * kPi, 80.0});
  const auto behind = [&](const RangeScan& scan) {
    const ScanCost cost(predictor_, scan, {});
    return toHypotheses({ranked(truth_, 0.0), ranked(wrong_, 0.5)}, scan, cost)[1].z_score;
  };
  EXPECT_NEAR(behind(fine), behind(coarse), 0.1 * behind(coarse));
}

TEST(ToHypotheses, PoseIsTheRobots) {
  const PolygonMap map = asymmetricRoom();
  const RangePredictor predictor(Triangulation(map), RangePredictor::kSquareSize, 1);
  const RangeScan scan = simulatedScan(map, {1.5, 2, 0.3}, {360, 2 * kPi, 80.0, {0.4, -0.2}});
  const TPose2D beams(3, 4, 1.2);
  const auto hypothesis = toHypotheses({ranked(beams, 0.1)}, scan, {predictor, scan, {}})[0];
  EXPECT_LT(distanceBetween(scan.beamFrameFromRobot(hypothesis.pose_map_robot), beams), 1e-12);
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
  expectNamed(&HypothesisParams::indifference, "indifference");
  expectNamed(&HypothesisParams::cell_share, "cell_share");
  expectNamed(&HypothesisParams::tolerance_share, "tolerance_share");
  expectNamed(&HypothesisParams::position_share, "position_share");
  expectNamed(&HypothesisParams::heading_share, "heading_share");
  expectNamed(&HypothesisParams::cell_size, "cell_size");
  HypothesisParams params;
  params.calibration.weight_decay = 0.0;
  EXPECT_THAT(complaintOf(params), HasSubstr("weight_decay"));
}

}  // namespace
}  // namespace mrpt_polyloc::test
