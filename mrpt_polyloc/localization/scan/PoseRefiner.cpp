#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

/// Hits, at most `max_beams` of them, evenly spread over the scan.
std::vector<Beam> chooseHits(const RangeScan& scan, std::size_t max_beams) {
  std::vector<Beam> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind == BeamKind::hit) hits.push_back(beam);
  }
  if (max_beams == 0 || hits.size() <= max_beams) return hits;
  std::vector<Beam> chosen;
  for (std::size_t i = 0; i < max_beams; ++i) {
    chosen.push_back(hits[i * hits.size() / max_beams]);
  }
  return chosen;
}

BeamPattern patternOf(const std::vector<Beam>& beams) {
  std::vector<double> bearings;
  for (const Beam& beam : beams) bearings.push_back(beam.bearing);
  return BeamPattern(bearings);
}

}  // namespace

/// The normal equations of one step, in the beam frame.
struct PoseRefiner::NormalEquations {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t beams = 0;
};

void PoseRefinerParams::check() const {
  requireInRange("max_iterations", max_iterations, 0.0, 1000.0);
  requirePositive("step_tolerance", step_tolerance);
  requirePositive("turn_tolerance", turn_tolerance);
  requirePositive("residual_scale", residual_scale);
  requirePositive("gate", gate);
  requirePositive("sigma", sigma);
}

PoseRefiner::PoseRefiner(const RangePredictor& predictor, const RangeScan& scan,
                         const PoseRefinerParams& params, std::size_t max_beams)
    : predictor_(&predictor), params_(params), pattern_(std::vector<double>{}) {
  const std::vector<Beam> hits = chooseHits(scan, max_beams);
  for (const Beam& hit : hits) {
    ranges_.push_back(static_cast<float>(hit.range));
    cosines_.push_back(std::cos(hit.bearing));
    sines_.push_back(std::sin(hit.bearing));
  }
  pattern_ = patternOf(hits);
}

RefinedPose PoseRefiner::refine(const mrpt::math::TPose2D& start) const {
  return refine(start, params_.max_iterations);
}

RefinedPose PoseRefiner::at(const mrpt::math::TPose2D& pose_map_beams) const {
  return refine(pose_map_beams, 0);
}

RefinementStep PoseRefiner::step(const mrpt::math::TPose2D& pose_map_beams) const {
  PredictedHits predicted;
  const NormalEquations equations = linearize(pose_map_beams, predicted);
  RefinementStep step;
  step.beams = equations.beams;
  for (int row = 0; row < 3; ++row) {
    step.right[static_cast<std::size_t>(row)] = equations.right[row];
    for (int column = 0; column < 3; ++column) {
      step.matrix(row, column) = equations.matrix(row, column);
    }
  }
  return step;
}

PoseRefiner::NormalEquations PoseRefiner::linearize(const mrpt::math::TPose2D& pose,
                                                    PredictedHits& predicted) const {
  const double inverse_scale = 1.0 / params_.residual_scale;
  predictor_->predict(pose, pattern_, predicted);
  NormalEquations equations;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double along = static_cast<double>(predicted.along[i]);
    const double across = static_cast<double>(predicted.across[i]);
    const double inverse_distance = std::sqrt(along * along + across * across);
    // No wall there, or the pose stands on it.
    if (!(inverse_distance > 0.0 && std::isfinite(inverse_distance))) continue;
    // The hit's distance beyond the line n.x = h, n the unit normal away from the robot.
    const double distance = 1.0 / inverse_distance;
    const double nx = along * distance, ny = across * distance;
    const double range = static_cast<double>(ranges_[i]);
    const double qx = range * cosines_[i], qy = range * sines_[i];
    const double residual = nx * qx + ny * qy - distance;
    if (std::abs(residual) > params_.gate) continue;
    // Moving the frame by (dx, dy, dphi) moves the hit by (dx - dphi qy, dy + dphi qx).
    const Eigen::Vector3d gradient(nx, ny, ny * qx - nx * qy);
    const double scaled = residual * inverse_scale;
    const double weight = 1.0 / (1.0 + scaled * scaled);
    const Eigen::Vector3d weighted = weight * gradient;
    equations.matrix.noalias() += weighted * gradient.transpose();
    equations.right -= residual * weighted;
    ++equations.beams;
  }
  return equations;
}

bool PoseRefiner::takeStep(const NormalEquations& equations, mrpt::math::TPose2D& pose) const {
  // A little damping: along a corridor nothing holds the pose.
  const Eigen::Matrix3d damped =
      equations.matrix + 1e-3 * static_cast<double>(equations.beams) * Eigen::Matrix3d::Identity();
  Eigen::Vector3d step = damped.ldlt().solve(equations.right);
  constexpr double kLongestStep = 0.3, kWidestTurn = 0.1;
  const double length = step.head<2>().norm();
  const double shrink = std::min({1.0, kLongestStep / std::max(length, 1e-12),
                                  kWidestTurn / std::max(std::abs(step[2]), 1e-12)});
  step *= shrink;
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  pose.x += c * step[0] - s * step[1];
  pose.y += s * step[0] + c * step[1];
  pose.phi += step[2];
  return step.head<2>().norm() < params_.step_tolerance &&
         std::abs(step[2]) < params_.turn_tolerance;
}

mrpt::math::TPose2D PoseRefiner::refinedPose(const mrpt::math::TPose2D& pose_map_beams) const {
  mrpt::math::TPose2D pose = pose_map_beams;
  PredictedHits predicted;
  for (int iteration = 0; iteration < params_.max_iterations; ++iteration) {
    const NormalEquations equations = linearize(pose, predicted);
    if (equations.beams < 3 || takeStep(equations, pose)) break;
  }
  pose.normalizePhi();
  return pose;
}

RefinedPose PoseRefiner::refine(const mrpt::math::TPose2D& start, int max_iterations) const {
  mrpt::math::TPose2D pose = start;
  PredictedHits predicted;
  NormalEquations equations = linearize(pose, predicted);
  bool is_short = false;
  for (int iteration = 0; iteration < max_iterations && equations.beams >= 3 && !is_short;
       ++iteration) {
    is_short = takeStep(equations, pose);
    equations = linearize(pose, predicted);
  }

  // From the beam frame's axes to the map's.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(pose.phi);
  turn(1, 0) = std::sin(pose.phi);
  turn(0, 1) = -turn(1, 0);
  const Eigen::Matrix3d information =
      turn * equations.matrix * turn.transpose() / (params_.sigma * params_.sigma);
  RefinedPose refined{pose, {}, equations.beams};
  refined.pose_map_beams.normalizePhi();
  refined.information = fromEigen(information);
  return refined;
}

}  // namespace mrpt_polyloc
