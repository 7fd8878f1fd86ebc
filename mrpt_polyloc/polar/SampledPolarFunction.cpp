#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mrpt_polyloc {

namespace {

std::vector<float> sampled(const PolarFunction& f, std::size_t k) {
  const CirclePlan& plan = CirclePlan::forSamples(k);
  std::vector<float> samples(k);
  const auto& pieces = f.pieces();
  std::size_t piece = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const double phi = kTwoPi * static_cast<double>(i) / static_cast<double>(k);
    while (piece + 1 < pieces.size() && pieces[piece + 1].begin <= phi) ++piece;
    samples[i] = static_cast<float>(pieces[piece].value(plan.directions()[i]));
  }
  return samples;
}

}  // namespace

SampledPolarFunction::SampledPolarFunction(const PolarFunction& f, std::size_t k)
    : SampledPolarFunction(sampled(f, k)) {}

SampledPolarFunction::SampledPolarFunction(std::vector<float> samples)
    : plan_(&CirclePlan::forSamples(samples.size())), samples_(std::move(samples)) {
  double sum = 0.0, sum_of_squares = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double value = static_cast<double>(samples_[i]);
    if (std::isnan(value)) {
      if (mask_.empty()) mask_.assign(size(), 1.0F);
      mask_[i] = samples_[i] = 0.0F;
      continue;
    }
    if (std::isinf(value) || value < 0.0)
      throw InvalidParamsError("sample " + std::to_string(i) + " = " +
                               formatted("%f", static_cast<double>(value)) +
                               " must be finite and not negative");
    ++valid_count_;
    sum += value;
    sum_of_squares += value * value;
  }
  if (valid_count_ == 0) throw InvalidParamsError("no sample is valid");
  const double count = static_cast<double>(size());
  mean_ = sum / static_cast<double>(valid_count_);
  squared_norm_ = kTwoPi / count * sum_of_squares;
  if (!isComplete()) {
    spectrum_norm_ = std::sqrt(sum_of_squares);
    spectrum_ = plan_->spectrum(samples_.data());
    mask_spectrum_ = plan_->spectrum(mask_.data());
    return;
  }
  std::vector<float> centered(size());
  double sum_of_centered_squares = 0.0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double value = static_cast<double>(samples_[i]) - mean_;
    centered[i] = static_cast<float>(value);
    sum_of_centered_squares += value * value;
  }
  spectrum_norm_ = std::sqrt(sum_of_centered_squares);
  spectrum_ = plan_->spectrum(centered.data());
}

}  // namespace mrpt_polyloc
