#pragma once

#include <mrpt_polyloc/base/export.h>

#include <vector>

namespace mrpt_polyloc {

/// A probability from a weighted sum of features: 1 / (1 + exp(-score)).
struct POLYLOC_EXPORT LogisticModel {
  double intercept = 0.0;
  std::vector<double> weights;  ///< one per feature

  /// intercept + sum of weight * feature. \throws std::out_of_range for another number of features
  double score(const std::vector<double>& features) const;
};

/// 1 / (1 + exp(-score)), without overflow.
POLYLOC_EXPORT double logistic(double score);

/// One example: its features, and whether it belongs to the class whose probability is wanted.
struct LogisticSample {
  std::vector<double> features;
  bool positive = false;
  double weight = 1.0;  ///< counts as so many examples
};

struct POLYLOC_EXPORT LogisticFitParams {
  /// Penalty on the squares of the weights, features scaled to unit deviation, in units of one
  /// example: enough to keep separable data finite, too little to matter else.
  double ridge = 1.0;
  int max_iterations = 100;
  double tolerance = 1e-10;  ///< of the largest step in a scaled weight

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The weights that make the examples likeliest, with a ridge penalty: Newton's method on
/// sum w log(1 + exp(-+score)) + ridge / 2 |scaled weights|^2, which is convex, with halved steps
/// where a full one does not descend. The intercept is not penalised. A feature that never changes
/// gets the weight 0.
/// \throws InvalidParamsError if an example has another number of features than the first, a value
/// that is not finite or a weight that is not positive, or if a class has no example.
POLYLOC_EXPORT LogisticModel fitLogistic(const std::vector<LogisticSample>& samples,
                                         const LogisticFitParams& params = {});

}  // namespace mrpt_polyloc
