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
Matrix3d widened(const CMatrixDouble33& covariance) {
  constexpr double kLeastStd = 0.002, kLeastStdAngle = 0.0017453;
  Matrix3d wider = toEigen(covariance);
  wider.diagonal() +=
      Vector3d(kLeastStd * kLeastStd, kLeastStd * kLeastStd, kLeastStdAngle * kLeastStdAngle);
  return wider;
}

/// Where nothing holds a pose it is known to half a metre and ten degrees: refinement is local.
Vector3d leastInformation() {
  constexpr double kWidestStd = 0.5, kWidestStdAngle = 0.1745;
  return {std::pow(kWidestStd, -2), std::pow(kWidestStd, -2), std::pow(kWidestStdAngle, -2)};
}

/// A movement along a way, and what it differs by from what the wheels said.
struct MovementAlongWay {
  Vector3d off;
  Eigen::Matrix<double, 3, 6> jacobian;  ///< by steps of both poses in their own axes
};

MovementAlongWay movementBetween(const TPose2D& before, const TPose2D& after,
                                 const Motion& motion) {
  MovementAlongWay movement;
  const TPose2D between = after - before;
  movement.off =
      Vector3d(between.x - motion.pose_before_after.x, between.y - motion.pose_before_after.y,
               std::remainder(between.phi - motion.pose_before_after.phi, 2.0 * M_PI));
  movement.jacobian.leftCols<3>() = -Matrix3d::Identity();
  movement.jacobian(0, 2) = between.y;
  movement.jacobian(1, 2) = -between.x;
  movement.jacobian.rightCols<3>() = turnOf(between.phi);
  return movement;
}

/// A pose moved in its own axes.
TPose2D moved(const TPose2D& pose, const Vector3d& step) {
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  return {pose.x + c * step[0] - s * step[1], pose.y + s * step[0] + c * step[1],
          pose.phi + step[2]};
}

/// What a step of that length and turn is multiplied by, so that it stays a short one.
double shrinkOf(double length, double turn) {
  constexpr double kLongestStep = 0.3, kWidestTurn = 0.1;  // [m, rad]
  return std::min(
      {1.0, kLongestStep / std::max(length, 1e-12), kWidestTurn / std::max(turn, 1e-12)});
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
  Eigen::VectorXd damping;      ///< of the diagonal
  std::vector<Matrix3d> scans;  ///< what each moment's scans put into the matrix
  double tension = 0.0;
};

/// Those of one moment's scans, in the robot's axes; not yet divided by a variance.
struct SetRefiner::MomentStep {
  Matrix3d matrix;
  Vector3d right;
  std::size_t beams = 0;
};

SetRefiner::SetRefiner(const RangePredictor& predictor, const ScanSet& set,
                       const MomentWeights& weights, const PoseRefinerParams& params,
                       const Calibration& calibration, std::size_t max_beams)
    : set_(&set),
      params_(params),
      variance_(std::pow(params.sigma * calibration.position_factor, 2)),
      own_variance_(std::pow(params.sigma, 2)) {
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

SetRefiner::MomentStep SetRefiner::stepAt(std::size_t k, const TPose2D& pose_map_robot) const {
  MomentStep sum{Matrix3d::Zero(), Vector3d::Zero(), 0};
  const Moment& moment = set_->moments()[k];
  for (std::size_t i = 0; i < moment.scans.size(); ++i) {
    const RangeScan& scan = moment.scans[i];
    const RefinementStep step = refiners_[k][i].step(scan.beamFrameFromRobot(pose_map_robot));
    // The beam frame's step from the robot's: a turn moves the sensor sideways.
    Matrix3d by_robot = Matrix3d::Identity();
    by_robot(0, 2) = -scan.sensor().y;
    by_robot(1, 2) = scan.sensor().x;
    sum.matrix += by_robot.transpose() * toEigen(step.matrix) * by_robot;
    sum.right += by_robot.transpose() * Vector3d(step.right[0], step.right[1], step.right[2]);
    sum.beams += step.beams;
  }
  return sum;
}

TPose2D SetRefiner::refineAlone(std::size_t k, const TPose2D& start) const {
  TPose2D pose = start;
  for (int iteration = 0; iteration < params_.max_iterations; ++iteration) {
    const MomentStep at = stepAt(k, pose);
    if (at.beams == 0) break;
    Matrix3d damped = at.matrix;
    damped.diagonal().array() += 1e-3 * static_cast<double>(at.beams) + 1e-9;
    Vector3d step = damped.ldlt().solve(at.right);
    if (!step.allFinite()) break;
    step *= shrinkOf(step.head<2>().norm(), std::abs(step[2]));
    pose = moved(pose, step);
    if (step.head<2>().norm() < params_.step_tolerance &&
        std::abs(step[2]) < params_.turn_tolerance) {
      break;
    }
  }
  pose.normalizePhi();
  return pose;
}

SetRefiner::System SetRefiner::linearize(const std::vector<TPose2D>& way, const GaussianPose* known,
                                         double wheel_scale) const {
  const auto size = static_cast<Eigen::Index>(3 * way.size());
  System system{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size),
                Eigen::VectorXd::Zero(size), std::vector<Matrix3d>(way.size(), Matrix3d::Zero())};
  for (std::size_t k = 0; k < way.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    const MomentStep step = stepAt(k, way[k]);
    const auto beams = static_cast<double>(step.beams);
    if (step.beams == 0) continue;
    // Of scans beside each other each says all that it says of its own pose: what they err by
    // together, as by the map, moves both poses, and tells nothing of the movement between them.
    // Nor is that error in the variance of a sector, then.
    const double share = known != nullptr ? known->share / variance_ : 1.0 / own_variance_;
    const double scale = share * std::min(1.0, sectors_[k] / beams);
    system.scans[k] = scale * step.matrix;
    system.matrix.block<3, 3>(at, at) += system.scans[k];
    system.right.segment<3>(at) += scale * step.right;
    // A little damping: along a corridor nothing holds the pose.
    system.damping.segment<3>(at).setConstant(1e-3 * scale * beams);
  }
  for (std::size_t k = 1; k < way.size(); ++k) {
    const auto before = static_cast<Eigen::Index>(3 * (k - 1));
    const Motion& motion = set_->moments()[k].since_before;
    const auto [off, jacobian] = movementBetween(way[k - 1], way[k], motion);
    const Matrix3d information = widened(motion.covariance).inverse() / std::pow(wheel_scale, 2);
    system.matrix.block<6, 6>(before, before) += jacobian.transpose() * information * jacobian;
    system.right.segment<6>(before) -= jacobian.transpose() * information * off;
    system.tension += off.dot(information * off);
  }
  if (known != nullptr) {
    const TPose2D& at = known->pose_map_robot;
    const Matrix3d turn = turnOf(way.front().phi);
    const Vector3d off(way.front().x - at.x, way.front().y - at.y,
                       std::remainder(way.front().phi - at.phi, 2.0 * M_PI));
    const Matrix3d information = widened(known->covariance).inverse();
    system.matrix.block<3, 3>(0, 0) += turn.transpose() * information * turn;
    system.right.segment<3>(0) -= turn.transpose() * information * off;
    system.tension += off.dot(information * off);
  }
  return system;
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start, const GaussianPose* known,
                              double wheel_scale, int max_iterations) const {
  std::vector<TPose2D> way = start;
  System system = linearize(way, known, wheel_scale);
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Eigen::MatrixXd damped = system.matrix;
    damped.diagonal() += system.damping + Eigen::VectorXd::Constant(system.damping.size(), 1e-9);
    Eigen::VectorXd step = damped.ldlt().solve(system.right);
    double length = 0.0, turn = 0.0;
    for (std::size_t k = 0; k < way.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(3 * k);
      length = std::max(length, step.segment<2>(at).norm());
      turn = std::max(turn, std::abs(step[at + 2]));
    }
    if (!std::isfinite(length + turn)) break;
    const double shrink = shrinkOf(length, turn);
    for (std::size_t k = 0; k < way.size(); ++k) {
      way[k] = moved(way[k], shrink * step.segment<3>(static_cast<Eigen::Index>(3 * k)));
    }
    system = linearize(way, known, wheel_scale);
    if (shrink * length < params_.step_tolerance && shrink * turn < params_.turn_tolerance) break;
  }

  RefinedWay refined{std::move(way), {}, system.tension};
  for (TPose2D& pose : refined.poses) pose.normalizePhi();
  // How well the way is known as a whole is another matter: there scans from nearly the same place
  // count as MomentWeights says, and with what they err by together.
  const double with_common = known != nullptr ? 1.0 : own_variance_ / variance_;
  for (std::size_t k = 0; k < refined.poses.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    system.matrix.block<3, 3>(at, at) -= (1.0 - shares_[k] * with_common) * system.scans[k];
  }
  const auto last = static_cast<Eigen::Index>(3 * (refined.poses.size() - 1));
  system.matrix.diagonal().segment<3>(last) += leastInformation();
  system.matrix.diagonal().array() += 1e-6;
  const Eigen::MatrixXd covariance = system.matrix.inverse();
  const Matrix3d axes = turnOf(refined.poses.back().phi);
  refined.covariance = fromEigen(axes * covariance.block<3, 3>(last, last) * axes.transpose());
  return refined;
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start, double wheel_scale) const {
  return refine(start, nullptr, wheel_scale, params_.max_iterations);
}

RefinedWay SetRefiner::refine(const std::vector<TPose2D>& start, const GaussianPose& known) const {
  return refine(start, &known, 1.0, params_.max_iterations);
}

RefinedWay SetRefiner::at(const std::vector<TPose2D>& way, double wheel_scale) const {
  return refine(way, nullptr, wheel_scale, 0);
}

std::vector<MovementError> SetRefiner::movementErrors(const std::vector<TPose2D>& way) const {
  const System system = linearize(way, nullptr, 1.0);
  std::vector<Matrix3d> of_poses;  // covariances by the scans of each moment alone
  for (Matrix3d information : system.scans) {
    information.diagonal() += leastInformation();
    of_poses.push_back(information.inverse());
  }
  std::vector<MovementError> errors;
  for (std::size_t k = 1; k < way.size(); ++k) {
    const Motion& motion = set_->moments()[k].since_before;
    const auto [off, jacobian] = movementBetween(way[k - 1], way[k], motion);
    const auto before = jacobian.leftCols<3>(), after = jacobian.rightCols<3>();
    MovementError error;
    error.off = {off[0], off[1], off[2]};
    error.wheels = fromEigen(widened(motion.covariance));
    error.scans = fromEigen(before * of_poses[k - 1] * before.transpose() +
                            after * of_poses[k] * after.transpose());
    errors.push_back(error);
  }
  return errors;
}

}  // namespace mrpt_polyloc
