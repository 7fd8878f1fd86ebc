#include "tests/support/simulated_scans.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/ranking/pose_covariance.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace mrpt_polyloc::test {
namespace {

using mrpt::math::TPose2D;

RefinedPose refined(const TPose2D& pose, const Eigen::Matrix3d& information,
                    std::size_t used_beams) {
  RefinedPose result;
  result.pose_map_beams = pose;
  result.used_beams = used_beams;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      result.information(row, column) = information(row, column);
    }
  }
  return result;
}

Calibration factors(double position, double heading) {
  Calibration calibration;
  calibration.position_factor = position;
  calibration.heading_factor = heading;
  return calibration;
}

RangeScan scanWithSensorAt(const TPoint2D& sensor) {
  return simulatedScan(asymmetricRoom(), {1.5, 2, 0.3}, {36, 2 * kPi, 80.0, sensor});
}

TEST(CovarianceOfRobot, IsThatOfPosesDrawnForTheSensorAndMovedToTheRobot) {
  const RangeScan scan = scanWithSensorAt({0.8, 0.5});
  const TPose2D beams(3, 4, 0.9);
  Eigen::Matrix3d factor;
  factor << 40, 0, 0, -10, 60, 0, 12, 5, 150;
  const Eigen::Matrix3d information = factor * factor.transpose();
  // Each of the 36 beams a sector of its own.
  const Eigen::Matrix3d covariance =
      toEigen(covarianceOfRobot(refined(beams, information, 36), scan, 36, factors(1, 1)));

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

TEST(CovarianceOfRobot, IsPositiveDefiniteEvenWhereTheScanHoldsNothing) {
  for (const double information : {0.0, 1e-3, 1.0, 1e8}) {
    Eigen::Matrix3d matrix = information * Eigen::Matrix3d::Identity();
    matrix(0, 0) = 0.0;
    for (const std::size_t beams : {0U, 3U, 360U}) {
      const Eigen::Matrix3d covariance = toEigen(covarianceOfRobot(
          refined({1, 2, 0.3}, matrix, beams), scanWithSensorAt({2, 1}), 20, factors(1.3, 0.7)));
      EXPECT_LT((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_EQ(Eigen::LLT<Eigen::Matrix3d>(covariance).info(), Eigen::Success);
    }
  }
}

TEST(CovarianceOfBeams, BeamsOfABlockInformOnce) {
  const Eigen::Matrix3d information = 1e9 * Eigen::Matrix3d::Identity();
  const auto variance = [&](std::size_t beams, std::size_t sectors) {
    return covarianceOfBeams(refined({1, 2, 0.3}, information, beams), sectors)(0, 0);
  };
  EXPECT_NEAR(variance(360, 36) / variance(36, 36), 10.0, 0.01);
  EXPECT_NEAR(variance(180, 18) / variance(36, 36), 10.0, 0.01);
  EXPECT_EQ(variance(10, 36), variance(36, 36));  // never more than the beams themselves
}

TEST(CovarianceOfRobot, FactorsScaleTheDeviations) {
  const Eigen::Matrix3d information = 1e9 * Eigen::Matrix3d::Identity();
  const auto covariance = [&](double position, double heading) {
    return toEigen(covarianceOfRobot(refined({1, 2, 0.3}, information, 36),
                                     scanWithSensorAt({0, 0}), 36, factors(position, heading)));
  };
  const Eigen::Matrix3d plain = covariance(1, 1), scaled = covariance(3, 0.5);
  EXPECT_NEAR(scaled(0, 0) / plain(0, 0), 9.0, 1e-3);
  EXPECT_NEAR(scaled(1, 1) / plain(1, 1), 9.0, 1e-3);
  EXPECT_NEAR(scaled(2, 2) / plain(2, 2), 0.25, 1e-3);
}

}  // namespace
}  // namespace mrpt_polyloc::test
