#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/matrices.h>
#include <mrpt_polyloc/evaluation/Summary.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mrpt_polyloc {

namespace {

struct PoseError {
  double distance;  // [m]
  double angle;     // [rad], in [0, pi]
};

PoseError errorOf(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth) {
  return {std::hypot(pose.x - truth.x, pose.y - truth.y),
          std::abs(std::remainder(pose.phi - truth.phi, kTwoPi))};
}

double fraction(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

bool isRightWithin(const ScanScore& score, std::size_t rank) {
  return score.right_rank > 0 && score.right_rank <= rank;
}

}  // namespace

bool isRight(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth,
             const Tolerance& tolerance) {
  const PoseError error = errorOf(pose, truth);
  return error.distance <= tolerance.distance && error.angle <= tolerance.angle;
}

bool isInEllipse(const mrpt::math::TPose2D& pose, const Hypothesis& hypothesis, double deviations) {
  const mrpt::math::TPose2D& middle = hypothesis.pose_map_robot;
  const Eigen::Vector3d off(pose.x - middle.x, pose.y - middle.y,
                            std::remainder(pose.phi - middle.phi, kTwoPi));
  const Eigen::LLT<Eigen::Matrix3d> covariance(toEigen(hypothesis.covariance));
  if (covariance.info() != Eigen::Success) return false;
  return off.dot(covariance.solve(off)) <= deviations * deviations;
}

ScanScore scoreScan(const LocalizationResult& result, const mrpt::math::TPose2D& truth,
                    const Tolerance& tolerance) {
  ScanScore score;
  score.status = result.status;
  score.error_m = score.error_rad = std::numeric_limits<double>::quiet_NaN();
  score.ms = result.statistics.search_ms + result.statistics.refinement_ms;
  for (std::size_t i = 0; i < result.hypotheses.size(); ++i) {
    const PoseError error = errorOf(result.hypotheses[i].pose_map_robot, truth);
    if (i == 0) {
      score.error_m = error.distance;
      score.error_rad = error.angle;
    }
    if (score.right_rank == 0 && isRight(result.hypotheses[i].pose_map_robot, truth, tolerance)) {
      score.right_rank = i + 1;
    }
    score.in_ellipse = score.in_ellipse || isInEllipse(truth, result.hypotheses[i]);
  }
  return score;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(std::floor(place));
  std::nth_element(values.begin(), below, values.end());
  const double low = *below;
  if (below + 1 == values.end()) return low;
  const double high = *std::min_element(below + 1, values.end());
  return low + (place - std::floor(place)) * (high - low);
}

Summary summarize(const std::vector<ScanScore>& scores, const std::vector<std::size_t>* rows) {
  std::vector<std::size_t> all;
  if (rows == nullptr) {
    all.resize(scores.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    rows = &all;
  }
  Summary summary;
  summary.scans = rows->size();
  if (rows->empty()) return summary;

  std::size_t top1 = 0, top5 = 0, top20 = 0, in_list = 0, in_ellipse = 0;
  std::size_t unique = 0, unique_right = 0;
  std::vector<double> errors_m, errors_deg, times;
  for (const std::size_t row : *rows) {
    const ScanScore& score = scores.at(row);
    ++summary.status.at(static_cast<std::size_t>(score.status));
    times.push_back(score.ms);
    // An answer withdrawn by its status is a miss, whatever the list holds.
    if (score.status == LocalizationStatus::no_match ||
        score.status == LocalizationStatus::too_few_beams)
      continue;
    const bool right = isRightWithin(score, 1);
    top1 += right ? 1 : 0;
    top5 += isRightWithin(score, 5) ? 1 : 0;
    top20 += isRightWithin(score, 20) ? 1 : 0;
    in_list += score.right_rank > 0 ? 1 : 0;
    in_ellipse += score.in_ellipse ? 1 : 0;
    if (score.status == LocalizationStatus::unique) {
      ++unique;
      unique_right += right ? 1 : 0;
    }
    if (right) {
      errors_m.push_back(score.error_m);
      errors_deg.push_back(score.error_rad / kDegree);
    }
  }
  summary.top1 = fraction(top1, rows->size());
  summary.top5 = fraction(top5, rows->size());
  summary.top20 = fraction(top20, rows->size());
  summary.in_list = fraction(in_list, rows->size());
  summary.in_ellipse = fraction(in_ellipse, rows->size());
  if (unique > 0) summary.unique_right = fraction(unique_right, unique);
  if (!errors_m.empty()) {
    summary.median_error_m = percentile(errors_m, 0.5);
    summary.median_error_deg = percentile(errors_deg, 0.5);
  }
  summary.ms_median = percentile(times, 0.5);
  summary.ms_p90 = percentile(times, 0.9);
  summary.ms_max = *std::max_element(times.begin(), times.end());
  return summary;
}

}  // namespace mrpt_polyloc
