#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::CMatrixDouble33;
using mrpt::math::TPose2D;

/// Of the composed pose a + b by a: where b lies turns with a's heading.
Eigen::Matrix3d byFirst(const TPose2D& a, const TPose2D& b) {
  const double c = std::cos(a.phi), s = std::sin(a.phi);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = -s * b.x - c * b.y;
  jacobian(1, 2) = c * b.x - s * b.y;
  return jacobian;
}

/// Of the composed pose a + b by b: its axes are turned by a's heading.
Eigen::Matrix3d turnedBy(double phi) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(phi);
  turn(1, 0) = std::sin(phi);
  turn(0, 1) = -turn(1, 0);
  return turn;
}

Eigen::Matrix3d composed(const TPose2D& a, const CMatrixDouble33& of_a, const TPose2D& b,
                         const CMatrixDouble33& of_b) {
  const Eigen::Matrix3d first = byFirst(a, b), second = turnedBy(a.phi);
  return first * toEigen(of_a) * first.transpose() + second * toEigen(of_b) * second.transpose();
}

}  // namespace

void MotionNoise::check() const {
  requireNotNegative("position_per_metre", position_per_metre);
  requireNotNegative("heading_per_metre", heading_per_metre);
  requireNotNegative("heading_per_radian", heading_per_radian);
}

double Motion::length() const {
  return std::hypot(pose_before_after.x, pose_before_after.y);
}

void Motion::check() const {
  constexpr double kGreatest = std::numeric_limits<double>::max();  // any finite number
  requireInRange("motion x", pose_before_after.x, -kGreatest, kGreatest);
  requireInRange("motion y", pose_before_after.y, -kGreatest, kGreatest);
  requireInRange("motion phi", pose_before_after.phi, -kGreatest, kGreatest);
  for (int row = 0; row < 3; ++row) {
    requireNotNegative("motion variance", covariance(row, row));
    for (int column = 0; column < 3; ++column) {
      requireInRange("motion covariance", covariance(row, column), -kGreatest, kGreatest);
    }
  }
}

Motion measuredMotion(const TPose2D& pose_before_after, const MotionNoise& noise) {
  Motion motion;
  motion.pose_before_after = pose_before_after;
  motion.pose_before_after.normalizePhi();
  const double length = motion.length();
  const double turn = std::abs(motion.pose_before_after.phi);
  const double std_position = noise.position_per_metre * length;
  motion.covariance(0, 0) = motion.covariance(1, 1) = std_position * std_position;
  motion.covariance(2, 2) =
      std::pow(noise.heading_per_metre * length, 2) + std::pow(noise.heading_per_radian * turn, 2);
  return motion;
}

Motion operator+(const Motion& first, const Motion& second) {
  Motion both;
  both.pose_before_after = first.pose_before_after + second.pose_before_after;
  both.pose_before_after.normalizePhi();
  both.covariance = fromEigen(composed(first.pose_before_after, first.covariance,
                                       second.pose_before_after, second.covariance));
  return both;
}

Motion inverse(const Motion& motion) {
  const TPose2D& there = motion.pose_before_after;
  Motion back;
  back.pose_before_after = TPose2D(0, 0, 0) - there;
  back.pose_before_after.normalizePhi();
  // there + back = 0, so that byFirst d(there) + turned d(back) = 0.
  const Eigen::Matrix3d jacobian =
      turnedBy(there.phi).transpose() * byFirst(there, back.pose_before_after);
  back.covariance = fromEigen(jacobian * toEigen(motion.covariance) * jacobian.transpose());
  return back;
}

TPose2D move(const TPose2D& pose_map_robot, const Motion& motion, CMatrixDouble33& covariance) {
  covariance =
      fromEigen(composed(pose_map_robot, covariance, motion.pose_before_after, motion.covariance));
  TPose2D moved = pose_map_robot + motion.pose_before_after;
  moved.normalizePhi();
  return moved;
}

}  // namespace mrpt_polyloc
