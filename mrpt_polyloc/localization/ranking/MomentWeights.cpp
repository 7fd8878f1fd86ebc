#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

/// How far apart [correlation lengths].
double separation(const Motion& motion, const ScanCorrelation& correlation) {
  return motion.length() / correlation.distance +
         std::abs(motion.pose_before_after.phi) / correlation.angle;
}

}  // namespace

void ScanCorrelation::check() const {
  requirePositive("correlation distance", distance);
  requirePositive("correlation angle", angle);
}

double ScanCorrelation::between(const Motion& motion) const {
  return std::exp(-separation(motion, *this));
}

double ScanCorrelation::gain(const Motion& motion) const {
  return std::tanh(0.5 * separation(motion, *this));
}

MomentWeights::MomentWeights(const ScanSet& set, const ScanCorrelation& correlation) {
  const std::size_t count = set.moments().size();
  correlations.assign(count, std::vector<double>(count, 1.0));
  weights.assign(count, 1.0);
  if (count == 1) return;
  constexpr double kRidge = 1e-6;  // moments at one place leave C singular
  const auto size = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd matrix(size, size);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      if (i != j) {
        correlations[i][j] = correlation.between(inverse(set.fromNow(i)) + set.fromNow(j));
      }
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          correlations[i][j] + (i == j ? kRidge : 0.0);
    }
  }
  Eigen::VectorXd best = matrix.ldlt().solve(Eigen::VectorXd::Ones(size));
  best = best.cwiseMax(0.0);  // a moment amid others may get less than nothing
  best /= best.sum();
  independent = 1.0 / best.dot(matrix * best);
  for (std::size_t i = 0; i < count; ++i) weights[i] = best[static_cast<Eigen::Index>(i)];
}

}  // namespace mrpt_polyloc
