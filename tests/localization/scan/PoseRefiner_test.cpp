#include "tests/support/params_messages.h"
#include "tests/support/random_maps.h"
#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;
using ::testing::HasSubstr;

RangePredictor predictorOf(const PolygonMap& map) {
  return RangePredictor(Triangulation(map), RangePredictor::kSquareSize, 1);
}

void expectSymmetricAndPositive(const mrpt::math::CMatrixDouble33& information) {
  const Eigen::Matrix3d m = toEigen(information);
  EXPECT_LE((m - m.transpose()).cwiseAbs().maxCoeff(), 1e-9 * m.cwiseAbs().maxCoeff());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  EXPECT_GE(solver.eigenvalues()[0], -1e-9 * std::abs(solver.eigenvalues()[2]));
}

/// A pose up to 8 cm and 2 degrees away.
TPose2D displaced(const TPose2D& pose, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double direction = kPi * unit(random), distance = 0.08 * std::abs(unit(random));
  return {pose.x + distance * std::cos(direction), pose.y + distance * std::sin(direction),
          pose.phi + 2 * kDegree * unit(random)};
}

TEST(PoseRefiner, FindsThePoseOfACleanScanFromNearby) {
  int right = 0, runs = 0;
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    FloorPlanParams params;
    params.rooms_per_side = 2;
    params.furniture_per_room = static_cast<int>(seed % 3);
    const PolygonMap map = floorPlan(params, seed);
    const RangePredictor predictor = predictorOf(map);
    std::mt19937 random(seed);
    for (const TPoint2D& p : randomFreePoints(map, 15, random)) {
      const TPose2D truth(p.x, p.y, std::uniform_real_distribution<double>(-3, 3)(random));
      const RangeScan scan = simulatedScan(map, truth);
      const TPose2D start = displaced(truth, random);
      const RefinedPose refined = PoseRefiner(predictor, scan).refine(start);
      const ScanCost cost(predictor, scan, {});
      EXPECT_LE(cost.mean(refined.pose_map_beams), cost.mean(start) + 0.005);
      expectSymmetricAndPositive(refined.information);
      ++runs;
      right += distanceBetween(refined.pose_map_beams, truth) < 0.01 &&
               turnBetween(refined.pose_map_beams, truth) < 0.1 * kDegree;
    }
  }
  EXPECT_GE(right, runs * 95 / 100) << "of " << runs;
}

TEST(PoseRefiner, StaysWhereTheScanFits) {
  const PolygonMap map = asymmetricRoom();
  const TPose2D truth(1.5, 2.5, 0.7);
  const RefinedPose refined =
      PoseRefiner(predictorOf(map), simulatedScan(map, truth)).refine(truth);
  EXPECT_LT(distanceBetween(refined.pose_map_beams, truth), 1e-4);
  EXPECT_LT(turnBetween(refined.pose_map_beams, truth), 1e-4);
  EXPECT_EQ(refined.used_beams, 360U);
}

TEST(PoseRefiner, BeamsThatEndEarlyHardlyDisturb) {
  const PolygonMap map = asymmetricRoom();
  const TPose2D truth(1.5, 2.5, 0.7);
  ScanOptions options;
  options.short_share = 0.3;
  const RefinedPose refined =
      PoseRefiner(predictorOf(map), simulatedScan(map, truth, options)).refine({1.55, 2.46, 0.72});
  EXPECT_LT(distanceBetween(refined.pose_map_beams, truth), 0.02);
  EXPECT_LT(turnBetween(refined.pose_map_beams, truth), 0.3 * kDegree);
}

TEST(PoseRefiner, UsesAsManyBeamsAsAskedFor) {
  const PolygonMap map = asymmetricRoom();
  const TPose2D truth(1.5, 2.5, 0.7);
  const RangeScan scan = simulatedScan(map, truth);
  const RefinedPose refined = PoseRefiner(predictorOf(map), scan, {}, 90).refine({1.53, 2.48, 0.7});
  EXPECT_LE(refined.used_beams, 90U);
  EXPECT_GE(refined.used_beams, 85U);
  EXPECT_LT(distanceBetween(refined.pose_map_beams, truth), 0.01);
}

TEST(PoseRefiner, AlongACorridorThePoseIsNotHeld) {
  const PolygonMap map = mapOf(rectangle(0, 0, 40, 2));
  ScanOptions options;
  options.max_range = 6.0;  // the ends are not seen
  const TPose2D truth(20, 1.2, 0.4);
  const RefinedPose refined =
      PoseRefiner(predictorOf(map), simulatedScan(map, truth, options)).refine({20.3, 1.15, 0.42});
  EXPECT_NEAR(refined.pose_map_beams.x, 20.3, 0.05);  // not moved along
  EXPECT_NEAR(refined.pose_map_beams.y, 1.2, 0.005);
  EXPECT_LT(turnBetween(refined.pose_map_beams, truth), 0.1 * kDegree);
  expectSymmetricAndPositive(refined.information);
  const Eigen::Matrix3d information = toEigen(refined.information);
  EXPECT_LT(information(0, 0), 1e-6 * information(1, 1));
}

TEST(PoseRefiner, WithoutHitsNothingMoves) {
  const PolygonMap map = asymmetricRoom();
  const RangePredictor predictor = predictorOf(map);
  const TPose2D start(1.5, 2.5, 0.7);
  for (const RangeScan& scan :
       {RangeScan({}), RangeScan({{0, 3, BeamKind::no_return}, {1, 3, BeamKind::no_return}})}) {
    const RefinedPose refined = PoseRefiner(predictor, scan).refine(start);
    EXPECT_EQ(distanceBetween(refined.pose_map_beams, start), 0.0);
    EXPECT_LT(turnBetween(refined.pose_map_beams, start), 1e-12);
    EXPECT_EQ(refined.used_beams, 0U);
    EXPECT_EQ(toEigen(refined.information), Eigen::Matrix3d::Zero());
  }
}

TEST(PoseRefiner, FromAnywhereThePoseStaysFinite) {
  const PolygonMap map = asymmetricRoom();
  const RangePredictor predictor = predictorOf(map);
  const RangeScan scan = simulatedScan(map, {1.5, 2.5, 0.7});
  const PoseRefiner refiner(predictor, scan);
  for (const double x : {-20.0, -1.0, 0.0, 3.0, 3.25, 3.5, 5.5, 7.0, 7.5, 1e6}) {
    for (const double y : {-1.0, 0.0, 2.0, 2.4, 2.8, 4.0, 6.0}) {  // on walls and corners, outside
      const RefinedPose refined = refiner.refine({x, y, 0.5});
      EXPECT_TRUE(std::isfinite(refined.pose_map_beams.x)) << x << " " << y;
      EXPECT_TRUE(std::isfinite(refined.pose_map_beams.y)) << x << " " << y;
      EXPECT_TRUE(std::isfinite(refined.pose_map_beams.phi)) << x << " " << y;
      EXPECT_TRUE(toEigen(refined.information).allFinite()) << x << " " << y;
    }
  }
}

TEST(PoseRefiner, InformationIsTheCurvatureOfTheSquaredDistances) {
  // A convex room seen from inside: each hit keeps its wall under small motions, and the wall's
  // line is known without the library.
  const std::vector<TPoint2D> corners{{0, 0}, {6, 0}, {7, 4}, {2, 5}};
  const PolygonMap map = mapOf(corners);
  const TPose2D truth(3, 2, 0.6);
  const RangeScan scan = simulatedScan(map, truth);
  PoseRefinerParams params;
  params.sigma = 0.03;
  const RefinedPose refined = PoseRefiner(predictorOf(map), scan, params).refine(truth);

  // Each hit's wall: the one it lies on at the true pose.
  std::vector<std::size_t> wall_of;
  const auto distance = [&](const TPose2D& pose, const Beam& beam, std::size_t wall) {
    const TPoint2D &a = corners[wall], &b = corners[(wall + 1) % corners.size()];
    const double x = pose.x + beam.range * std::cos(pose.phi + beam.bearing);
    const double y = pose.y + beam.range * std::sin(pose.phi + beam.bearing);
    const double dx = b.x - a.x, dy = b.y - a.y;
    return (dx * (y - a.y) - dy * (x - a.x)) / std::hypot(dx, dy);
  };
  for (const Beam& beam : scan.beams()) {
    std::size_t best = 0;
    for (std::size_t wall = 1; wall < corners.size(); ++wall) {
      if (std::abs(distance(truth, beam, wall)) < std::abs(distance(truth, beam, best))) {
        best = wall;
      }
    }
    wall_of.push_back(best);
  }
  const auto half_squares = [&](const Eigen::Vector3d& moved) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scan.beams().size(); ++i) {
      const TPose2D pose(truth.x + moved[0], truth.y + moved[1], truth.phi + moved[2]);
      sum += 0.5 * std::pow(distance(pose, scan.beams()[i], wall_of[i]) / params.sigma, 2);
    }
    return sum;
  };
  constexpr double kStep = 1e-3;
  Eigen::Matrix3d curvature;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d b = kStep * Eigen::Vector3d::Unit(k);
      curvature(i, k) =
          (half_squares(a + b) - half_squares(a - b) - half_squares(b - a) + half_squares(-a - b)) /
          (4 * kStep * kStep);
    }
  }
  const Eigen::Matrix3d information = toEigen(refined.information);
  EXPECT_LT((information - curvature).cwiseAbs().maxCoeff(), 1e-3 * curvature.cwiseAbs().maxCoeff())
      << information << "\n\n"
      << curvature;
}

TEST(PoseRefinerParams, ChecksNameTheField) {
  EXPECT_EQ(complaintOf(PoseRefinerParams{}), "");
  PoseRefinerParams params;
  params.max_iterations = -1;
  EXPECT_THAT(complaintOf(params), HasSubstr("max_iterations"));
  const auto expectNamed = [](double PoseRefinerParams::*field, const std::string& name) {
    for (const double bad : {0.0, -1.0, std::nan("")}) {
      PoseRefinerParams with_bad;
      with_bad.*field = bad;
      EXPECT_THAT(complaintOf(with_bad), HasSubstr(name));
    }
  };
  expectNamed(&PoseRefinerParams::step_tolerance, "step_tolerance");
  expectNamed(&PoseRefinerParams::residual_scale, "residual_scale");
  expectNamed(&PoseRefinerParams::gate, "gate");
  expectNamed(&PoseRefinerParams::sigma, "sigma");
}

}  // namespace
}  // namespace mrpt_polyloc::test
