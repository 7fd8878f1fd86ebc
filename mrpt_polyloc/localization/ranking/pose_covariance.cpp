#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/ranking/pose_covariance.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

/// \param factors of the standard deviations of x, y and phi
Eigen::Matrix3d localCovariance(const RefinedPose& pose, std::size_t sectors,
                                const Eigen::Vector3d& factors) {
  constexpr double kWidestStd = 0.5, kWidestStdAngle = 0.1745;
  const auto beams = static_cast<double>(std::max<std::size_t>(pose.used_beams, 1));
  // More sectors than beams: each beam is an observation, none counts twice.
  const double share = std::min(1.0, static_cast<double>(sectors) / beams);
  const Eigen::Vector3d narrowed = factors.cwiseInverse();
  Eigen::Matrix3d information =
      narrowed.asDiagonal() * (share * toEigen(pose.information)) * narrowed.asDiagonal();
  information.diagonal() += Eigen::Vector3d(std::pow(kWidestStd, -2), std::pow(kWidestStd, -2),
                                            std::pow(kWidestStdAngle, -2));
  return information.inverse();
}

}  // namespace

mrpt::math::CMatrixDouble33 covarianceOfBeams(const RefinedPose& pose, std::size_t sectors) {
  return fromEigen(localCovariance(pose, sectors, Eigen::Vector3d::Ones()));
}

mrpt::math::CMatrixDouble33 covarianceOfRobot(const RefinedPose& pose, const RangeScan& scan,
                                              std::size_t sectors, const Calibration& calibration) {
  const Eigen::Matrix3d of_beams = localCovariance(
      pose, sectors,
      {calibration.position_factor, calibration.position_factor, calibration.heading_factor});
  // The robot's origin turns with the heading: robot = beams - R(phi) sensor.
  const double c = std::cos(pose.pose_map_beams.phi), s = std::sin(pose.pose_map_beams.phi);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = s * scan.sensor().x + c * scan.sensor().y;
  jacobian(1, 2) = -c * scan.sensor().x + s * scan.sensor().y;
  return fromEigen(jacobian * of_beams * jacobian.transpose());
}

}  // namespace mrpt_polyloc
