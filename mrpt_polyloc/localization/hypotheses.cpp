#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/hypotheses.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

bool isNear(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b,
            const HypothesisParams& params) {
  return std::hypot(a.x - b.x, a.y - b.y) < params.merge_distance &&
         angleBetween(a.phi, b.phi) < params.merge_angle;
}

/// Mean and standard error of the differences of two cost vectors, by blocks of beams.
struct PairedDifference {
  double mean = 0.0;
  double standard_error = 0.0;
};

PairedDifference pairedDifference(const std::vector<float>& a, const std::vector<float>& b,
                                  std::size_t beams_per_block) {
  std::vector<double> blocks;
  for (std::size_t first = 0; first < a.size(); first += beams_per_block) {
    const std::size_t last = std::min(first + beams_per_block, a.size());
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      sum += static_cast<double>(b[i]) - static_cast<double>(a[i]);
    }
    blocks.push_back(sum / static_cast<double>(last - first));
  }
  PairedDifference difference;
  const auto n = static_cast<double>(blocks.size());
  for (const double block : blocks) difference.mean += block / n;
  double squares = 0.0;
  for (const double block : blocks) squares += std::pow(block - difference.mean, 2);
  if (blocks.size() > 1) difference.standard_error = std::sqrt(squares / (n - 1.0) / n);
  return difference;
}

/// Covariance of the robot's pose. Neighbouring beams err together: a block of them informs once.
/// Where the scan holds nothing (along a corridor) the pose is taken to be known to 0.5 m and 10
/// degrees: a hypothesis is local.
mrpt::math::CMatrixDouble33 covarianceOfRobot(const RefinedPose& pose, const RangeScan& scan,
                                              const HypothesisParams& params) {
  constexpr double kWidestStd = 0.5, kWidestStdAngle = 0.1745;
  Eigen::Matrix3d information;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      information(row, column) =
          pose.information(row, column) / static_cast<double>(params.beams_per_block);
    }
  }
  information.diagonal() += Eigen::Vector3d(std::pow(kWidestStd, -2), std::pow(kWidestStd, -2),
                                            std::pow(kWidestStdAngle, -2));
  // The robot's origin turns with the heading: robot = beams - R(phi) sensor.
  const double c = std::cos(pose.pose_map_beams.phi), s = std::sin(pose.pose_map_beams.phi);
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = s * scan.sensor().x + c * scan.sensor().y;
  jacobian(1, 2) = -c * scan.sensor().x + s * scan.sensor().y;
  const Eigen::Matrix3d covariance = jacobian * information.inverse() * jacobian.transpose();
  mrpt::math::CMatrixDouble33 result;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) result(row, column) = covariance(row, column);
  }
  return result;
}

}  // namespace

void HypothesisParams::check() const {
  requirePositive("merge_distance", merge_distance);
  requirePositive("merge_angle", merge_angle);
  requirePositive("no_match_cost", no_match_cost);
  requireNotNegative("rival_cost", rival_cost);
  requireNotNegative("rival_deviations", rival_deviations);
  requireInRange("beams_per_block", static_cast<double>(beams_per_block), 1.0, 1e6);
  requirePositive("weight_scale", weight_scale);
}

std::vector<RankedPose> mergeNearPoses(std::vector<RankedPose> poses,
                                       const HypothesisParams& params) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const RankedPose& a, const RankedPose& b) { return a.cost < b.cost; });
  std::vector<RankedPose> merged;
  for (const RankedPose& pose : poses) {
    const bool is_new = std::none_of(merged.begin(), merged.end(), [&](const RankedPose& other) {
      return isNear(pose.refined.pose_map_beams, other.refined.pose_map_beams, params);
    });
    if (is_new) merged.push_back(pose);
  }
  return merged;
}

bool isUnique(const std::vector<RankedPose>& poses, const ScanCost& cost,
              const HypothesisParams& params) {
  if (poses.empty()) return false;
  const std::vector<float> best = cost.perBeam(poses.front().refined.pose_map_beams);
  return std::none_of(poses.begin() + 1, poses.end(), [&](const RankedPose& rival) {
    const PairedDifference difference =
        pairedDifference(best, cost.perBeam(rival.refined.pose_map_beams), params.beams_per_block);
    return difference.mean <
           std::max(params.rival_cost, params.rival_deviations * difference.standard_error);
  });
}

std::vector<Hypothesis> toHypotheses(const std::vector<RankedPose>& poses, const RangeScan& scan,
                                     const HypothesisParams& params) {
  std::vector<Hypothesis> hypotheses;
  if (poses.empty()) return hypotheses;
  const double blocks = static_cast<double>(scan.hitCount() + scan.noReturnCount()) /
                        static_cast<double>(params.beams_per_block);
  double sum = 0.0;
  for (const RankedPose& pose : poses) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = scan.robotFromBeamFrame(pose.refined.pose_map_beams);
    hypothesis.covariance = covarianceOfRobot(pose.refined, scan, params);
    hypothesis.cost = pose.cost;
    hypothesis.weight = std::exp(-(pose.cost - poses.front().cost) * blocks / params.weight_scale);
    sum += hypothesis.weight;
    hypotheses.push_back(hypothesis);
  }
  for (Hypothesis& hypothesis : hypotheses) hypothesis.weight /= sum;
  return hypotheses;
}

}  // namespace mrpt_polyloc
