#pragma once

#include <mrpt_polyloc/polar/CirclePlan.h>
#include <mrpt_polyloc/polar/PolarFunction.h>

#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A polar function sampled at k equidistant directions phi_i = 2 pi i / k, with its spectrum ready
/// for comparison under all k rotations. Samples in directions that the view does not reach are
/// invalid.
///
/// Immutable. Memory: 8 k bytes, and 8 k more for a partial view.
class SampledPolarFunction {
 public:
  static constexpr std::size_t kDefaultSamples = 360;  ///< one a degree, as most scanners

  /// f at phi_i, as value() gives it (points, not means).
  /// \throws InvalidParamsError unless k is even and has no prime factor above 5; see CirclePlan.
  explicit SampledPolarFunction(const PolarFunction& f, std::size_t k = kDefaultSamples);

  /// From samples [m]; NaN marks an invalid one. \throws InvalidParamsError for a bad number of
  /// samples, a sample that is infinite or negative (named), or if all are invalid.
  explicit SampledPolarFunction(std::vector<float> samples);

  std::size_t size() const { return samples_.size(); }
  /// [m], 0 where invalid.
  const std::vector<float>& samples() const { return samples_; }
  bool isComplete() const { return mask_.empty(); }  ///< every sample is valid
  bool isValid(std::size_t i) const { return mask_.empty() || mask_[i] != 0.0F; }
  std::size_t validCount() const { return valid_count_; }
  double mean() const { return mean_; }  ///< of the valid samples [m]
  /// (2 pi / k) Sum of the valid samples' squares [m2]: approximates the integral of f^2.
  double squaredNorm() const { return squared_norm_; }

  const CirclePlan& plan() const { return *plan_; }
  /// Of the samples less their mean; of the samples as they are if the view is partial (shifted
  /// masked samples would no longer be comparable).
  const std::vector<std::complex<float>>& spectrum() const { return spectrum_; }
  /// Euclidean norm of what spectrum() transforms.
  double spectrumNorm() const { return spectrum_norm_; }
  /// 1 where valid, else 0; empty if complete.
  const std::vector<float>& mask() const { return mask_; }
  /// Of the mask; empty if complete.
  const std::vector<std::complex<float>>& maskSpectrum() const { return mask_spectrum_; }

 private:
  const CirclePlan* plan_;
  std::vector<float> samples_;
  std::vector<float> mask_;
  std::size_t valid_count_ = 0;
  double mean_ = 0.0;
  double squared_norm_ = 0.0;
  double spectrum_norm_ = 0.0;
  std::vector<std::complex<float>> spectrum_;
  std::vector<std::complex<float>> mask_spectrum_;
};

}  // namespace mrpt_polyloc
