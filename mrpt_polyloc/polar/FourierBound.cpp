#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/FourierBound.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrpt_polyloc {

namespace {

template <class View>
void checkComplete(const View& f) {
  if (!f.isComplete())
    throw InvalidParamsError("a view with unseen directions has no Fourier feature");
}

/// The feature from |F_0|, ..., |F_order|.
std::vector<double> featureOf(std::vector<double> magnitudes, double squared_norm) {
  double sum = 0.0;
  for (std::size_t j = 0; j < magnitudes.size(); ++j) {
    magnitudes[j] *= std::sqrt(j == 0 ? kTwoPi : 2.0 * kTwoPi);
    sum += magnitudes[j] * magnitudes[j];
  }
  magnitudes.push_back(std::sqrt(std::max(0.0, squared_norm - sum)));
  return magnitudes;
}

}  // namespace

std::vector<double> fourierFeature(const PolarFunction& f, std::size_t order) {
  checkComplete(f);
  std::vector<double> magnitudes;
  for (const auto& coefficient : f.fourierCoefficients(order))
    magnitudes.push_back(std::abs(coefficient));
  return featureOf(std::move(magnitudes), f.squaredNorm());
}

std::vector<double> fourierFeature(const SampledPolarFunction& f, std::size_t order) {
  checkComplete(f);
  const std::size_t k = f.size();
  if (order > (k - 1) / 2)
    throw InvalidParamsError("order = " + std::to_string(order) + " must be at most " +
                             std::to_string((k - 1) / 2) + " for " + std::to_string(k) +
                             " samples");
  // The spectrum is that of the samples less their mean, times k^(1/2).
  const double scale = 1.0 / std::sqrt(static_cast<double>(k));
  std::vector<double> magnitudes{std::abs(f.mean())};
  for (std::size_t j = 1; j <= order; ++j)
    magnitudes.push_back(scale * static_cast<double>(std::abs(f.spectrum()[j])));
  return featureOf(std::move(magnitudes), f.squaredNorm());
}

}  // namespace mrpt_polyloc
