#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/evaluation/calibration_samples.h>

#include <Eigen/Dense>

#include <cmath>

namespace mrpt_polyloc {
namespace {

/// Position error, by its covariance.
double positionSquare(const Hypothesis& hypothesis, const mrpt::math::TPose2D& truth) {
  Eigen::Matrix2d covariance;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column) {
      covariance(row, column) = hypothesis.covariance(row, column);
    }
  }
  const Eigen::Vector2d error(hypothesis.pose_map_robot.x - truth.x,
                              hypothesis.pose_map_robot.y - truth.y);
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace

Calibration uncalibrated() {
  Calibration calibration;
  calibration.least_match_probability = 0.0;
  calibration.position_factor = calibration.heading_factor = 1.0;
  return calibration;
}

std::optional<CalibrationSample> calibrationSample(const LocalizationResult& result,
                                                   const mrpt::math::TPose2D* truth,
                                                   const Tolerance& tolerance) {
  if (result.hypotheses.empty() || !result.features) return std::nullopt;
  CalibrationSample sample;
  sample.features = *result.features;
  for (const Hypothesis& hypothesis : result.hypotheses) {
    const bool right = truth != nullptr && isRight(hypothesis.pose_map_robot, *truth, tolerance);
    sample.candidates.push_back({hypothesis.z_score, right});
  }
  if (sample.candidates.front().right) {
    const Hypothesis& first = result.hypotheses.front();
    sample.position_square = positionSquare(first, *truth);
    const double turn = std::remainder(first.pose_map_robot.phi - truth->phi, kTwoPi);
    sample.heading_square = turn * turn / first.covariance(2, 2);
  }
  return sample;
}

}  // namespace mrpt_polyloc
