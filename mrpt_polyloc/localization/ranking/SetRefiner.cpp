#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/localization/ranking/SetRefiner.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mrpt::math::CMatrixDouble33;
using mrpt::math::TPose2D;

Matrix3d turnOf(double phi) {
  Matrix3d turn = Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(phi);
  turn(1, 0) = std::sin(phi);
  turn(0, 1) = -turn(1, 0);
  return turn;
}

/// Of a covariance whose owner is never surer than to 2 mm and a tenth of a degree: wheels that did
/// not move say no more.
Matrix3d informationOf(const CMatrixDouble33& covariance) {
  constexpr double kLeastStd = 0.002, kLeastStdAngle = 0.0017453;
  Matrix3d widened = toEigen(covariance);
  widened.diagonal() +=
      Vector3d(kLeastStd * kLeastStd, kLeastStd * kLeastStd, kLeastStdAngle * kLeastStdAngle);
  return widened.inverse();
}

/// A pose moved in its own axes.
TPose2D moved(const TPose2D& pose, const Vector3d& step) {
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  return {pose.x + c * step[0] - s * step[1], pose.y + s * step[0] + c * step[1],
          pose.phi + step[2]};
}

/// Beams of all lasers of a moment fall into so many sectors.
double sectorsOf(const Moment& moment) {
  std::vector<Beam> hits;
  for (const RangeScan& scan : moment.scans) {
    std::copy_if(scan.beams().begin(), scan.beams().end(), std::back_inserter(hits),
                 [](const Beam& beam) { return beam.kind == BeamKind::hit; });
  }
  return static_cast<double>(BeamSectors(hits).count());
}

}  // namespace

/// Normal equations of a whole way, each pose's step in its own axes.
struct SetRefiner::System {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
  Eigen::VectorXd damping;  ///< of the diagonal
  double tension = 0.0;
};

SetRefiner::SetRefiner(const RangePredictor& predictor, const ScanSet& set,
                       const MomentWeights& weights, const PoseRefinerParams& params,
                       const Calibration& calibration, std::size_t max_beams)
    : set_(&set),
      params_(params),
      variance_(std::pow(params.sigma * calibration.position_factor, 2)) {
  for (std::size_t k = 0; k < set.moments().size(); ++k) {
    const Moment& moment = set.moments()[k];
    std::vector<PoseRefiner> refiners;
    for (const RangeScan& scan : moment.scans) {
      refiners.emplace_back(predictor, scan, params, max_beams);
    }
    refiners_.push_back(std::move(refiners));
    sectors_.push_back(sectorsOf(moment));
    shares_.push_back(std::min(1.0, weights.weights[k] * weights.independent));
  }
}

std::vector<TPose2D> SetRefiner::wayTo(const TPose2D& pose_map_robot) const {
  std::vector<TPose2D> way(set_->moments().size());
  for (std::size_t k = 0; k < way.size(); ++k) {
    way[k] = pose_map_robot + set_->fromNow(k).pose_before_after;
  }
  way.back() = pose_map_robot;
  return way;
}

SetRefiner::System SetRefiner::linearize(const std::vector<TPose2D>& way,
                                         const GaussianPose* known) const {
  const auto size = static_cast<Eigen::Index>(3 * way.size());
  System system{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size),
                Eigen::VectorXd::Zero(size)};
  for (std::size_t k = 0; k < way.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    const Moment& moment = set_->moments()[k];
    Matrix3d matrix = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    std::size_t beams = 0;
    for (std::size_t i = 0; i < moment.scans.size(); ++i) {
      const RangeScan& scan = moment.scans[i];
      const RefinementStep step = refiners_[k][i].step(scan.beamFrameFromRobot(way[k]));
      // The beam frame's step from the robot's: a turn moves the sensor sideways.
      Matrix3d by_robot = Matrix3d::Identity();
      by_robot(0, 2) = -scan.sensor().y;
      by_robot(1, 2) = scan.sensor().x;
      matrix += by_robot.transpose() * toEigen(step.matrix) * by_robot;
      right += by_robot.transpose() * Vector3d(step.right[0], step.right[1], step.right[2]);
      beams += step.beams;
    }
    if (beams == 0) continue;
    const double share = (known != nullptr ? known->share : 1.0) * shares_[k];
    const double scale =
        share * std::min(1.0, sectors_[k] / static_cast<double>(beams)) / variance_;
    system.matrix.block<3, 3>(at, at) += scale * matrix;
    system.right.segment<3>(at) += scale * right;
    // A little damping: along a corridor nothing holds the pose.
    system.damping.segment<3>(at).setConstant(1e-3 * scale * static_cast<double>(beams));
  }
  for (std::size_t k = 1; k < way.size(); ++k) {
    const auto before = static_cast<Eigen::Index>(3 * (k - 1));
    const Motion& motion = set_->moments()[k].since_before;
    const TPose2D between = way[k] - way[k - 1];
    const Vector3d off(between.x - motion.pose_before_after.x,
                       between.y - motion.pose_before_after.y,
                       std::remainder(between.phi - motion.pose_before_after.phi, 2.0 * M_PI));
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.leftCols<3>() = -Matrix3d::Identity();
    jacobian(0, 2) = between.y;
    jacobian(1, 2) = -between.x;
    jacobian.rightCols<3>() = turnOf(between.phi);
    const Matrix3d information = informationOf(motion.covariance);
    system.matrix.block<6, 6>(before, before) += jacobian.transpose() * information * jacobian;
    system.right.segment<6>(before) -= jacobian.transpose() * information * off;
    system.tension += off.dot(information * off);
  }
  if (known != nullptr) {
    const TPose2D& at = known->pose_map_robot;
    const Matrix3d turn = turnOf(way.front().phi);
    const Vector3d off(way.front().x - at.x, way.front().y - at.y,
                       std::remainder(way.front().phi - at.phi, 2.0 * M_PI));
    const Matrix3d information = informationOf(known->covariance);
    system.matrix.block<3, 3>(0, 0) += turn.transpose() * information * turn;
    system.right.segment<3>(0) -= turn.transpose() * information * off;
    system.tension += off.dot(information * off);
  }
  return system;
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start, const GaussianPose* known,
                              int max_iterations) const {
  std::vector<TPose2D> way = start;
  System system = linearize(way, known);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::MatrixXd damped = system.matrix;
    damped.diagonal() += system.damping + Eigen::VectorXd::Constant(system.damping.size(), 1e-9);
    Eigen::VectorXd step = damped.ldlt().solve(system.right);
    constexpr double kLongestStep = 0.3, kWidestTurn = 0.1;
    double length = 0.0, turn = 0.0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(3 * k);
      length = std::max(length, step.segment<2>(at).norm());
      turn = std::max(turn, std::abs(step[at + 2]));
    }
    if (!std::isfinite(length + turn)) break;
    const double shrink = std::min(
        {1.0, kLongestStep / std::max(length, 1e-12), kWidestTurn / std::max(turn, 1e-12)});
    for (std::size_t k = 0; k < way.size(); ++k) {
      way[k] = moved(way[k], shrink * step.segment<3>(static_cast<Eigen::Index>(3 * k)));
    }
    system = linearize(way, known);
    if (shrink * length < params_.step_tolerance && shrink * turn < params_.turn_tolerance) break;
  }

  RefinedWay refined{std::move(way), {}, system.tension};
  for (TPose2D& pose : refined.poses) pose.normalizePhi();
  // Where nothing holds the way it is known to half a metre and ten degrees: it is local.
  constexpr double kWidestStd = 0.5, kWidestStdAngle = 0.1745;
  const auto last = static_cast<Eigen::Index>(3 * (refined.poses.size() - 1));
  system.matrix.diagonal().segment<3>(last) +=
      Vector3d(std::pow(kWidestStd, -2), std::pow(kWidestStd, -2), std::pow(kWidestStdAngle, -2));
  system.matrix.diagonal().array() += 1e-6;
  const Eigen::MatrixXd covariance = system.matrix.inverse();
  const Matrix3d axes = turnOf(refined.poses.back().phi);
  refined.covariance = fromEigen(axes * covariance.block<3, 3>(last, last) * axes.transpose());
  return refined;
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start) const {
  return refine(start, nullptr, params_.max_iterations);
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start, const GaussianPose& known) const {
  return refine(start, &known, params_.max_iterations);
}

RefinedWay SetRefiner::at(const std::vector<TPose2D>& way) const {
  return refine(way, nullptr, 0);
}

}  // namespace mrpt_polyloc
