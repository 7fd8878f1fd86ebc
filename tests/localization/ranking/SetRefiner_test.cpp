#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/ranking/SetRefiner.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

/// A way through the asymmetric room, with what wheels say that are off by `error` a movement, and
/// not trusted.
struct Way {
  std::vector<TPose2D> truth;
  ScanSet set;
};

Way wayThroughRoom(const PolygonMap& map, const TPose2D& error, const ScanOptions& options = {}) {
  const std::vector<TPose2D> truth{{1, 1, 0.2}, {1.6, 1.2, 0.5}, {2.0, 1.6, 1.1}, {2.2, 2.4, 1.3}};
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    Motion motion;
    if (k > 0) motion = measuredMotion((truth[k] - truth[k - 1]) + error, {1.0, 1.0, 1.0});
    moments.push_back({{simulatedScan(map, truth[k], options)}, motion, false});
  }
  return {truth, ScanSet(std::move(moments))};
}

class SetRefinerTest : public ::testing::Test {
 protected:
  const PolygonMap map_ = asymmetricRoom();
  const Triangulation triangulation_{map_};
  const RangePredictor predictor_{triangulation_};
};

TEST_F(SetRefinerTest, FindsTheWholeWayThoughWheelsAreOff) {
  ScanOptions options;
  options.field_of_view = kPi;
  options.sensor = {0.2, 0.1};
  const Way way = wayThroughRoom(map_, {0.02, -0.02, 0.03}, options);
  const SetRefiner refiner(predictor_, way.set, MomentWeights(way.set, {}));
  TPose2D start = way.truth.back();
  start.x += 0.08;
  start.y -= 0.05;
  start.phi += 0.04;
  const RefinedWay refined = refiner.refine(refiner.wayTo(start));
  for (std::size_t k = 0; k < way.truth.size(); ++k) {
    EXPECT_LT(distanceBetween(refined.poses[k], way.truth[k]), 0.005) << k;
    EXPECT_LT(turnBetween(refined.poses[k], way.truth[k]), 0.003) << k;
  }
  EXPECT_GT(refined.tension, 1e-4);
}

TEST_F(SetRefinerTest, ScansBesideEachOtherTellTheMovementBetweenThem) {
  // Wheels that claim much and are wrong by ten times that, believed and not.
  const std::vector<TPose2D> truth{{1, 1, 0.2}, {1.3, 1.1, 0.3}, {1.6, 1.2, 0.4}};
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    Motion motion;
    if (k > 0) motion = measuredMotion((truth[k] - truth[k - 1]) + TPose2D(0.06, -0.06, 0.05));
    moments.push_back({{simulatedScan(map_, truth[k])}, motion, false});
  }
  const ScanSet set(std::move(moments));
  const SetRefiner refiner(predictor_, set, MomentWeights(set, {}));
  const auto worst = [&](const RefinedWay& way) {
    double distance = 0.0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      distance = std::max(distance, distanceBetween(way.poses[k], truth[k]));
    }
    return distance;
  };
  const std::vector<TPose2D> start = refiner.wayTo(truth.back());
  const RefinedWay believed = refiner.refine(start), doubted = refiner.refine(start, 10.0);
  EXPECT_LT(worst(doubted), 0.01);
  EXPECT_GT(worst(believed), 2.0 * worst(doubted));
  // At another scale the same way has another tension.
  EXPECT_NEAR(refiner.at(doubted.poses).tension, 100.0 * doubted.tension, 0.01 * doubted.tension);
  // The scans alone find their poses from where the wheels lead, and say what those are off by.
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_LT(distanceBetween(refiner.refineAlone(k, start[k]), truth[k]), 0.005) << k;
  }
  const std::vector<MovementError> errors = refiner.movementErrors(truth);
  ASSERT_EQ(errors.size(), 2U);
  for (const MovementError& error : errors) {
    EXPECT_NEAR(std::hypot(error.off[0], error.off[1]), std::hypot(0.06, 0.06), 0.02);
    EXPECT_LT(error.scans(0, 0), std::pow(0.1, 2));
    EXPECT_LT(error.wheels(0, 0), std::pow(0.01, 2));
  }
}

TEST_F(SetRefinerTest, WhatIsKnownOfAWayFollowsItsIndependentMoments) {
  // A robot that stands still knows its pose no better by looking four times.
  const RangeScan scan = simulatedScan(map_, {2.5, 3, 0.7});
  const ScanSet once(scan);
  const ScanSet often(
      {{{scan}, {}, false}, {{scan}, {}, false}, {{scan}, {}, false}, {{scan}, {}, false}});
  const auto deviation = [&](const ScanSet& set) {
    const SetRefiner refiner(predictor_, set, MomentWeights(set, {}));
    return std::sqrt(refiner.refine(refiner.wayTo({2.5, 3, 0.7})).covariance(0, 0));
  };
  EXPECT_NEAR(deviation(often) / deviation(once), 1.0, 0.1);
}

TEST_F(SetRefinerTest, OfOneMomentIsThePoseRefiner) {
  const RangeScan scan = simulatedScan(map_, {2.5, 3, 0.7});
  const ScanSet set(scan);
  const SetRefiner refiner(predictor_, set, MomentWeights(set, {}));
  const PoseRefiner alone(predictor_, scan);
  const TPose2D start(2.6, 2.93, 0.75);
  const RefinedWay refined = refiner.refine({start});
  const RefinedPose expected = alone.refine(start);
  EXPECT_LT(distanceBetween(refined.poses.front(), expected.pose_map_beams), 1e-4);
  EXPECT_LT(turnBetween(refined.poses.front(), expected.pose_map_beams), 1e-4);
  EXPECT_EQ(refined.tension, 0.0);
}

TEST_F(SetRefinerTest, WhatIsKnownBeforeHoldsAPoseThatTheScanDoesNot) {
  // Two parallel walls, seen sideways only: along them the prior decides.
  const PolygonMap corridor = mapOf(rectangle(0, 0, 60, 2));
  const Triangulation triangulation(corridor);
  const RangePredictor predictor(triangulation);
  ScanOptions options;
  options.max_range = 5.0;
  const ScanSet set(simulatedScan(corridor, {30, 1, 0}, options));
  const SetRefiner refiner(predictor, set, MomentWeights(set, {}));
  GaussianPose known{{29.7, 1.1, 0.05}, mrpt::math::CMatrixDouble33::Zero(), 1.0};
  known.covariance(0, 0) = known.covariance(1, 1) = 0.04;
  known.covariance(2, 2) = 0.01;
  const RefinedWay refined = refiner.refine({TPose2D(29.7, 1.1, 0.05)}, known);
  EXPECT_NEAR(refined.poses.front().x, 29.7, 0.01);
  EXPECT_NEAR(refined.poses.front().y, 1.0, 0.02);
  EXPECT_NEAR(refined.poses.front().phi, 0.0, 0.01);
  EXPECT_NEAR(refined.covariance(0, 0), 0.04, 0.01);
  EXPECT_LT(refined.covariance(1, 1), 0.002);
}

TEST_F(SetRefinerTest, WhatIsFoundIsAtLeastAsGoodAsPosesNearby) {
  // No way nearby has a smaller sum of robust squares: the optimum, by trial.
  const Way way = wayThroughRoom(map_, {0.01, 0.01, -0.01});
  const MomentWeights weights(way.set, {});
  const SetRefiner refiner(predictor_, way.set, weights);
  const RefinedWay refined = refiner.refine(refiner.wayTo(way.truth.back()));
  // A second descent from the end moves nothing.
  const RefinedWay again = refiner.refine(refined.poses);
  for (std::size_t k = 0; k < refined.poses.size(); ++k) {
    EXPECT_LT(distanceBetween(refined.poses[k], again.poses[k]), 5e-4);
  }
  // From many starts nearby it is the same end.
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    TPose2D start = way.truth.back();
    start.x += random.uniform(-0.1, 0.1);
    start.y += random.uniform(-0.1, 0.1);
    start.phi += random.uniform(-0.05, 0.05);
    const RefinedWay other = refiner.refine(refiner.wayTo(start));
    EXPECT_LT(distanceBetween(refined.poses.back(), other.poses.back()), 2e-3);
  }
}

}  // namespace
}  // namespace mrpt_polyloc::test
