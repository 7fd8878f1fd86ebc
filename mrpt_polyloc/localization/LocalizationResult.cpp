#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {

LocalizationResult resultOf(Assessment assessment) {
  LocalizationResult result;
  result.status = assessment.status;
  result.match_probability = assessment.match_probability;
  result.features = assessment.features;
  result.wheel_scale = assessment.wheel_scale;
  result.hypotheses = std::move(assessment.hypotheses);
  result.listed = assessment.listed;
  return result;
}

namespace {

mrpt::math::CMatrixDouble33 diagonal(double x, double y, double phi) {
  mrpt::math::CMatrixDouble33 covariance;
  covariance.setZero();
  covariance(0, 0) = x;
  covariance(1, 1) = y;
  covariance(2, 2) = phi;
  return covariance;
}

/// Equally likely ones, of which at most so many are returned.
LocalizationResult resultOf(std::vector<Hypothesis> all, bool is_unique, std::size_t most) {
  LocalizationResult result;
  result.match_probability = all.empty() ? 0.0 : 1.0;  // without noise nothing is left to chance
  result.status = all.empty() ? LocalizationStatus::no_match
                  : is_unique ? LocalizationStatus::unique
                              : LocalizationStatus::ambiguous;
  const double weight = all.empty() ? 0.0 : 1.0 / static_cast<double>(all.size());
  all.resize(std::min(all.size(), most));
  for (Hypothesis& hypothesis : all) hypothesis.weight = weight;
  result.listed = weight * static_cast<double>(all.size());
  result.hypotheses = std::move(all);
  return result;
}

Hypothesis hypothesisAt(const mrpt::math::TPose2D& pose,
                        const mrpt::math::CMatrixDouble33& covariance) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = pose;
  hypothesis.covariance = covariance;
  return hypothesis;
}

}  // namespace

LocalizationResult resultOf(const ExactAnswers& answers, double tolerance,
                            std::size_t max_hypotheses) {
  const double square = tolerance * tolerance;
  std::vector<Hypothesis> all;
  for (const auto& pose : answers.poses) {
    all.push_back(hypothesisAt(pose, diagonal(square, square, square)));
  }
  LocalizationResult result = resultOf(std::move(all), answers.poses.size() == 1, max_hypotheses);
  result.statistics.positions = answers.positions;
  result.statistics.evaluated = answers.evaluated;
  return result;
}

LocalizationResult resultOf(const LimitedAnswers& answers, double tolerance,
                            std::size_t max_hypotheses) {
  const double square = tolerance * tolerance;
  std::vector<Hypothesis> all;
  for (const auto& pose : answers.points) {
    all.push_back(hypothesisAt(pose, diagonal(square, square, square)));
  }
  for (const LimitedAnswers::Segment& segment : answers.segments) {
    const auto middle = (segment.from + segment.to) * 0.5, along = segment.to - segment.from;
    auto covariance =
        diagonal(square + along.x * along.x / 12.0, square + along.y * along.y / 12.0, square);
    covariance(0, 1) = covariance(1, 0) = along.x * along.y / 12.0 + 0.0;  // no -0
    all.push_back(hypothesisAt({middle.x, middle.y, segment.heading}, covariance));
  }
  if (answers.region) {
    const double range = answers.region->clearance;
    const auto& inside = answers.region->inside;
    all.push_back(hypothesisAt({inside.x, inside.y, 0.0},
                               diagonal(range * range, range * range, kTwoPi * kTwoPi / 12.0)));
  }
  const bool is_unique = all.size() == 1 && answers.points.size() == 1;
  return resultOf(std::move(all), is_unique, max_hypotheses);
}

}  // namespace mrpt_polyloc
