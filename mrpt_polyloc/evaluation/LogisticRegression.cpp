#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/LogisticRegression.h>

#include <Eigen/Dense>

#include <cmath>
#include <stdexcept>

namespace mrpt_polyloc {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// log(1 + exp(x)), without overflow.
double softplus(double x) {
  return x > 0.0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x));
}

/// The examples as a matrix, each feature scaled to mean 0 and deviation 1, and a column of ones.
struct Design {
  MatrixXd rows;
  VectorXd labels, weights;  ///< labels: 1 or 0
  VectorXd mean, deviation;  ///< of the features
};

void checkSamples(const std::vector<LogisticSample>& samples) {
  bool positive = false, negative = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const LogisticSample& sample = samples[i];
    const std::string name = "sample " + std::to_string(i);
    if (sample.features.size() != samples.front().features.size()) {
      throw InvalidParamsError(name + " has " + std::to_string(sample.features.size()) +
                               " features, the first one " +
                               std::to_string(samples.front().features.size()));
    }
    for (const double feature : sample.features) {
      if (!std::isfinite(feature)) throw InvalidParamsError(name + ": a feature is not finite");
    }
    requirePositive((name + ": weight").c_str(), sample.weight);
    (sample.positive ? positive : negative) = true;
  }
  if (!positive || !negative) {
    throw InvalidParamsError(std::string("there is no ") + (positive ? "negative" : "positive") +
                             " sample");
  }
}

Design makeDesign(const std::vector<LogisticSample>& samples) {
  const auto count = static_cast<Eigen::Index>(samples.size());
  const auto features = static_cast<Eigen::Index>(samples.front().features.size());
  Design design{MatrixXd::Ones(count, features + 1), VectorXd(count), VectorXd(count),
                VectorXd::Zero(features), VectorXd::Ones(features)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const LogisticSample& sample = samples[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < features; ++j) {
      design.rows(i, j) = sample.features[static_cast<std::size_t>(j)];
    }
    design.labels[i] = sample.positive ? 1.0 : 0.0;
    design.weights[i] = sample.weight;
  }
  for (Eigen::Index j = 0; j < features; ++j) {
    auto column = design.rows.col(j);
    design.mean[j] = column.mean();
    column.array() -= design.mean[j];
    const double deviation = std::sqrt(column.squaredNorm() / static_cast<double>(count));
    // What never changes tells nothing; rounding must not be blown up to a feature.
    if (deviation > 1e-12 * (1.0 + std::abs(design.mean[j]))) {
      design.deviation[j] = deviation;
      column /= deviation;
    } else {
      column.setZero();
    }
  }
  return design;
}

double objective(const Design& design, const VectorXd& weights, double ridge) {
  const VectorXd scores = design.rows * weights;
  double sum = 0.5 * ridge * weights.head(weights.size() - 1).squaredNorm();
  for (Eigen::Index i = 0; i < scores.size(); ++i) {
    sum += design.weights[i] * softplus(design.labels[i] > 0.5 ? -scores[i] : scores[i]);
  }
  return sum;
}

/// Newton's step from the given weights.
VectorXd newtonStep(const Design& design, const VectorXd& weights, double ridge) {
  const VectorXd scores = design.rows * weights;
  VectorXd residual(scores.size()), curvature(scores.size());
  for (Eigen::Index i = 0; i < scores.size(); ++i) {
    const double p = logistic(scores[i]);
    residual[i] = design.weights[i] * (design.labels[i] - p);
    curvature[i] = design.weights[i] * p * (1.0 - p);
  }
  VectorXd gradient = design.rows.transpose() * residual;
  MatrixXd hessian = design.rows.transpose() * curvature.asDiagonal() * design.rows;
  const Eigen::Index features = weights.size() - 1;
  gradient.head(features) -= ridge * weights.head(features);
  hessian.diagonal().head(features).array() += ridge;
  // All probabilities may round to 0 or 1.
  hessian.diagonal().array() += 1e-12;
  return hessian.ldlt().solve(gradient);
}

}  // namespace

double LogisticModel::score(const std::vector<double>& features) const {
  if (features.size() != weights.size()) {
    throw std::out_of_range("LogisticModel: " + std::to_string(features.size()) + " features for " +
                            std::to_string(weights.size()) + " weights");
  }
  double sum = intercept;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * features[i];
  return sum;
}

double logistic(double score) {
  if (score >= 0.0) return 1.0 / (1.0 + std::exp(-score));
  const double e = std::exp(score);
  return e / (1.0 + e);
}

void LogisticFitParams::check() const {
  requirePositive("ridge", ridge);
  requireInRange("max_iterations", max_iterations, 1.0, 1e6);
  requirePositive("tolerance", tolerance);
}

LogisticModel fitLogistic(const std::vector<LogisticSample>& samples,
                          const LogisticFitParams& params) {
  params.check();
  checkSamples(samples);
  const Design design = makeDesign(samples);
  VectorXd weights = VectorXd::Zero(design.rows.cols());
  double value = objective(design, weights, params.ridge);
  for (int iteration = 0; iteration < params.max_iterations; ++iteration) {
    VectorXd step = newtonStep(design, weights, params.ridge);
    double next = objective(design, weights + step, params.ridge);
    for (int halvings = 0; !(next <= value) && halvings < 50; ++halvings) {
      step *= 0.5;
      next = objective(design, weights + step, params.ridge);
    }
    if (!(next <= value)) break;  // at the optimum up to rounding
    weights += step;
    value = next;
    if (step.cwiseAbs().maxCoeff() < params.tolerance) break;
  }
  LogisticModel model;
  const Eigen::Index features = weights.size() - 1;
  model.intercept = weights[features];
  for (Eigen::Index j = 0; j < features; ++j) {
    model.weights.push_back(weights[j] / design.deviation[j]);
    model.intercept -= model.weights.back() * design.mean[j];
  }
  return model;
}

}  // namespace mrpt_polyloc
