#include "tests/support/map_factories.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/ranking/valleys.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// A corridor of 60 m, 2 m wide, and a laser of 3.5 m: what lies in between looks alike.
PolygonMap corridor() {
  return mapOf(rectangle(0, 0, 60, 2));
}

/// The same with niches of equal doors, 0.3 m deep, 1 m wide, each 3 m, on both sides.
PolygonMap corridorOfDoors() {
  std::vector<TPoint2D> v{{0, 0}};
  for (double x = 1.0; x < 59.0; x += 3.0) {
    v.insert(v.end(), {{x, 0}, {x, -0.3}, {x + 1, -0.3}, {x + 1, 0}});
  }
  v.insert(v.end(), {{60, 0}, {60, 2}});
  for (double x = 58.0; x > 1.0; x -= 3.0) {
    v.insert(v.end(), {{x + 1, 2}, {x + 1, 2.3}, {x, 2.3}, {x, 2}});
  }
  v.emplace_back(0, 2);
  return mapOf(std::move(v));
}

RangeScan shortSighted(const PolygonMap& map, const TPose2D& truth) {
  ScanOptions options;
  options.sigma = 0.02;
  options.max_range = 3.5;
  return simulatedScan(map, truth, options);
}

double sumOfWeights(const LocalizationResult& result) {
  return std::accumulate(result.hypotheses.begin(), result.hypotheses.end(), 0.0,
                         [](double sum, const Hypothesis& h) { return sum + h.weight; });
}

double longestDeviation(const Hypothesis& hypothesis) {
  const Eigen::Matrix2d position = toEigen(hypothesis.covariance).topLeftCorner<2, 2>();
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(position).eigenvalues()[1]);
}

/// Whether a pose lies within so many deviations of a hypothesis.
bool isWithin(const Hypothesis& hypothesis, const TPose2D& pose, double deviations) {
  const Eigen::Vector3d off(pose.x - hypothesis.pose_map_robot.x,
                            pose.y - hypothesis.pose_map_robot.y,
                            std::remainder(pose.phi - hypothesis.pose_map_robot.phi, 2 * kPi));
  return off.dot(toEigen(hypothesis.covariance).ldlt().solve(off)) < deviations * deviations;
}

TEST(Valleys, ACorridorIsTwoLongHypothesesOneForEachWay) {
  const PolygonMap map = corridor();
  const GlobalLocalizer localizer(map);
  for (const double x : {12.0, 31.75, 45.0}) {
    SCOPED_TRACE(x);
    const TPose2D truth{x, 0.76, 0.47};
    const RangeScan scan = shortSighted(map, truth);
    SearchOptions apart;
    apart.max_hypotheses = 10000;
    apart.unite_valleys = false;
    const LocalizationResult all = localizer.localize(scan, {}, apart);
    const LocalizationResult result = localizer.localize(scan);
    EXPECT_GT(all.hypotheses.size(), 100U);  // else the corridor is none
    EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
    EXPECT_EQ(result.status, all.status);
    ASSERT_GE(result.hypotheses.size(), 2U);
    EXPECT_LE(result.hypotheses.size(), 12U);  // at the ends the scan sees more
    EXPECT_NEAR(result.listed, 1.0, 1e-9);
    EXPECT_NEAR(sumOfWeights(result), result.listed, 1e-9);
    // Scores still are what the weights follow from.
    for (const Hypothesis& h : result.hypotheses) {
      if (h.weight < 1e-12) continue;
      EXPECT_NEAR(h.weight,
                  result.hypotheses[0].weight * std::exp(-Calibration{}.weight_decay * h.z_score),
                  1e-9);
    }
    // A valley is whole, however few are asked for.
    SearchOptions many;
    many.max_hypotheses = 10000;
    const Hypothesis whole = localizer.localize(scan, {}, many).hypotheses[0];
    EXPECT_EQ(whole.pose_map_robot, result.hypotheses[0].pose_map_robot);
    EXPECT_NEAR(longestDeviation(whole), longestDeviation(result.hypotheses[0]), 0.05);
    std::vector<Hypothesis> by_weight = result.hypotheses;
    std::sort(by_weight.begin(), by_weight.end(),
              [](const Hypothesis& a, const Hypothesis& b) { return a.weight > b.weight; });
    EXPECT_GT(by_weight[0].weight + by_weight[1].weight, 0.7);
    EXPECT_GT(longestDeviation(by_weight[0]), 10.0);  // uniform over 50 m: 14.4
    EXPECT_LT(longestDeviation(by_weight[0]), 20.0);
    EXPECT_NEAR(std::abs(by_weight[0].pose_map_robot.x - 30.0), 0.0, 5.0);
    EXPECT_TRUE(std::any_of(result.hypotheses.begin(), result.hypotheses.end(),
                            [&](const Hypothesis& h) { return isWithin(h, truth, 3.0); }));
    // Each of those united lies in the ellipse of one.
    for (const Hypothesis& one : all.hypotheses) {
      EXPECT_TRUE(
          std::any_of(result.hypotheses.begin(), result.hypotheses.end(),
                      [&](const Hypothesis& h) { return isWithin(h, one.pose_map_robot, 3.0); }))
          << one.pose_map_robot.x;
    }
  }
}

TEST(Valleys, EqualDoorsAreNotUnited) {
  const PolygonMap map = corridorOfDoors();
  const GlobalLocalizer localizer(map);
  const TPose2D truth{30.4, 0.8, 0.3};
  SearchOptions options;
  options.max_hypotheses = 10000;
  const LocalizationResult result = localizer.localize(shortSighted(map, truth), {}, options);
  EXPECT_EQ(result.status, LocalizationStatus::ambiguous);
  EXPECT_GT(result.hypotheses.size(), 20U);  // about one a door and way
  for (const Hypothesis& hypothesis : result.hypotheses) {
    EXPECT_LT(longestDeviation(hypothesis), 0.7);
  }
  EXPECT_NEAR(sumOfWeights(result), result.listed, 1e-9);
}

TEST(Valleys, OfARoomThereAreNone) {
  const PolygonMap map = asymmetricRoom();
  const GlobalLocalizer localizer(map);
  SearchOptions apart;
  apart.unite_valleys = false;
  const RangeScan scan = simulatedScan(map, {1.5, 2.1, 0.3});
  const LocalizationResult a = localizer.localize(scan), b = localizer.localize(scan, {}, apart);
  ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
  for (std::size_t i = 0; i < a.hypotheses.size(); ++i) {
    EXPECT_EQ(a.hypotheses[i].pose_map_robot, b.hypotheses[i].pose_map_robot);
    EXPECT_EQ(a.hypotheses[i].weight, b.hypotheses[i].weight);
  }
}

/// Each rule by itself: poses with an information and a cost of their own, in a room.
class ValleyRules : public testing::Test {
 protected:
  ValleyRules()
      : map_(squareMap()),
        triangulation_(map_),
        predictor_(triangulation_),
        cost_(predictor_, simulatedScan(map_, {5.0, 5.0, 0.0}), RobustCostParams{}),
        sectors_(cost_.beams()) {}

  /// Known to 1 cm but along x, where the information is `along` [1/m^2]; the way between two such
  /// is level, whatever lies on it.
  static ScoredPose longAlongX(const TPose2D& pose, double along = 0.0, double cost = 10.0) {
    ScoredPose scored;
    scored.refined.pose_map_beams = pose;
    scored.refined.information = fromEigen(Eigen::Vector3d(along, 1e4, 1e4).asDiagonal());
    scored.refined.used_beams = 1;
    scored.cost = cost;
    return scored;
  }
  static ScoredPose longAlongY(const TPose2D& pose) {
    ScoredPose scored = longAlongX(pose);
    scored.refined.information = fromEigen(Eigen::Vector3d(1e4, 0.0, 1e4).asDiagonal());
    return scored;
  }
  bool isOne(const ScoredPose& a, const ScoredPose& b) const {
    const std::vector<std::size_t> valley = valleysOf({a, b}, cost_, sectors_);
    EXPECT_EQ(valley, valleysOf({b, a}, cost_, sectors_));
    EXPECT_EQ(valley[0], 0U);
    return valley[1] == 0;
  }

  PolygonMap map_;
  Triangulation triangulation_;
  RangePredictor predictor_;
  ScanCost cost_;
  BeamSectors sectors_;
};

TEST_F(ValleyRules, BothMustBeUncertainByAQuarterOfAMetre) {
  const ScoredPose one = longAlongX({4.0, 5.0, 0.0});
  // What nothing holds has a deviation of half a metre: 4 / m^2 more information.
  EXPECT_TRUE(isOne(one, longAlongX({5.0, 5.0, 0.0}, 11.9)));
  EXPECT_FALSE(isOne(one, longAlongX({5.0, 5.0, 0.0}, 12.1)));
}

TEST_F(ValleyRules, BothMustLieOnTheLineAlongWhichTheyAreUncertain) {
  const ScoredPose one = longAlongX({4.0, 5.0, 0.0});
  EXPECT_TRUE(isOne(one, longAlongX({4.8, 5.19, 0.0})));
  EXPECT_FALSE(isOne(one, longAlongX({4.8, 5.21, 0.0})));
  EXPECT_FALSE(isOne(one, longAlongY({4.8, 5.0, 0.0})));
  EXPECT_FALSE(isOne(one, longAlongY({4.0, 5.8, 0.0})));
}

TEST_F(ValleyRules, TheyLookTheSameWayAndStandBesideEachOther) {
  const ScoredPose one = longAlongX({4.0, 5.0, 0.03});
  EXPECT_TRUE(isOne(one, longAlongX({5.0, 5.0, -0.039})));
  EXPECT_FALSE(isOne(one, longAlongX({5.0, 5.0, -0.041})));
  EXPECT_FALSE(isOne(one, longAlongX({5.0, 5.0, 0.03 + kPi})));
  EXPECT_TRUE(isOne(one, longAlongX({5.49, 5.0, 0.03})));
  EXPECT_FALSE(isOne(one, longAlongX({5.51, 5.0, 0.03})));
  // But for those between them.
  EXPECT_EQ(
      valleysOf({one, longAlongX({6.4, 5.0, 0.03}), longAlongX({5.2, 5.0, 0.03})}, cost_, sectors_),
      (std::vector<std::size_t>{0, 0, 0}));
}

TEST_F(ValleyRules, TheWayBetweenRisesByNoMoreThanACentimetre) {
  // A metre in four steps: up to 0.75 m from where the scan was taken, which is the dearest.
  const double between = cost_.mean({5.75, 5.0, 0.0});
  ASSERT_GT(between, cost_.mean({5.5, 5.0, 0.0}));
  const auto isOneAt = [&](double below) {
    return isOne(longAlongX({5.0, 5.0, 0.0}, 0.0, between - below - 0.1),
                 longAlongX({6.0, 5.0, 0.0}, 0.0, between - below));
  };
  EXPECT_TRUE(isOneAt(0.009));
  EXPECT_FALSE(isOneAt(0.011));
}

Hypothesis hypothesisAt(double x, double weight) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = {x, 0.0, 0.0};
  hypothesis.weight = weight;
  hypothesis.cost = 0.01 * x;
  hypothesis.covariance = fromEigen(Eigen::Vector3d(0.25, 0.01, 0.001).asDiagonal());
  return hypothesis;
}

TEST(Valleys, UnitedHypothesesHaveTheMomentsOfTheirMixture) {
  const std::vector<Hypothesis> four{hypothesisAt(1, 0.4), hypothesisAt(7, 0.3),
                                     hypothesisAt(3, 0.2), hypothesisAt(2, 0.1)};
  const std::vector<Hypothesis> result = uniteValleys(four, {0, 1, 0, 0});
  ASSERT_EQ(result.size(), 2U);
  // They stand for 0.5, 1 and 0.5 m of the valley: 0.2 at 1, 0.1 at 2, 0.1 at 3; the mean is 1.75.
  EXPECT_EQ(result[0].pose_map_robot.x, 2.0);
  EXPECT_EQ(result[0].cost, 0.02);
  EXPECT_NEAR(result[0].weight, 0.7, 1e-12);
  EXPECT_NEAR(result[0].covariance(0, 0), 0.25 + (0.2 * 1 + 0.1 * 1) / 0.4, 1e-12);
  EXPECT_NEAR(result[0].covariance(1, 1), 0.01, 1e-12);
  EXPECT_EQ(result[1].pose_map_robot.x, 7.0);
  EXPECT_EQ(result[1].weight, 0.3);
}

TEST(Valleys, TheHeaviestIsFirstOnceUnited) {
  const std::vector<Hypothesis> result =
      uniteValleys({hypothesisAt(1, 0.4), hypothesisAt(7, 0.3), hypothesisAt(8, 0.3)}, {0, 1, 1});
  ASSERT_EQ(result.size(), 2U);
  EXPECT_NEAR(result[0].weight, 0.6, 1e-12);
  EXPECT_EQ(result[1].weight, 0.4);
}

}  // namespace
}  // namespace mrpt_polyloc::test
