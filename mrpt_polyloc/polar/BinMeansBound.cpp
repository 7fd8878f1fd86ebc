#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/BinMeansBound.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

// Of a sum of squares in single precision, some 20 terms deep, and of what it is the difference of.
constexpr double kRounding = 1e-5;

/// out_i = (in_i + in_{i + step}) / 2 for k samples, indices wrapped; `in` has place for k + step.
POLYLOC_HOT_LOOP
void averagePairs(float* __restrict__ in, std::size_t k, std::size_t step,
                  float* __restrict__ out) {
  for (std::size_t i = 0; i < step; ++i) in[k + i] = in[i];
  for (std::size_t i = 0; i < k; ++i) out[i] = 0.5F * (in[i] + in[i + step]);
}

POLYLOC_HOT_LOOP
void cutOff(const float* __restrict__ samples, std::size_t k, float reach,
            float* __restrict__ out) {
  for (std::size_t i = 0; i < k; ++i) out[i] = samples[i] < reach ? samples[i] : reach;
}

/// The means of `width` (a power of two) neighbours from each of k samples on, by doubling; twice
/// over, so that no index wraps. \returns 2 k floats, in one of the two buffers of that size
const float* slidingMeans(const float* samples, std::size_t k, float reach, std::size_t width,
                          float* buffer, float* other) {
  cutOff(samples, k, reach, buffer);
  for (std::size_t step = 1; step < width; step *= 2) {
    averagePairs(buffer, k, step, other);
    std::swap(buffer, other);
  }
  std::copy_n(buffer, k, buffer + k);
  return buffer;
}

constexpr std::size_t kRun = 32;  // rotations whose sums are kept in registers

/// The least over n rotations of the summed squared differences of the bins' means. Reads up to
/// kRun - 1 places beyond the last rotation's.
POLYLOC_HOT_LOOP
float leastSum(const float* means, std::size_t n, const std::uint32_t* starts,
               const float* bin_means, std::size_t bins) {
  std::array<float, kRun> least;
  least.fill(std::numeric_limits<float>::infinity());
  for (std::size_t s = 0; s < n; s += kRun) {
    std::array<float, kRun> sums{};
    for (std::size_t b = 0; b < bins; ++b) {
      const float* const run = means + starts[b] + s;
      const float mean = bin_means[b];
      for (std::size_t i = 0; i < kRun; ++i) {
        const float e = run[i] - mean;
        sums[i] += e * e;
      }
    }
    const std::size_t used = std::min(kRun, n - s);
    for (std::size_t i = 0; i < used; ++i) least[i] = sums[i] < least[i] ? sums[i] : least[i];
  }
  return *std::min_element(least.begin(), least.end());
}

}  // namespace

BinMeansBound::BinMeansBound(const SampledPolarFunction& f, std::size_t width,
                             const RotationRange& range)
    : k_(f.size()),
      width_(width),
      rotations_(indicesIn(range, f.size())),
      norm_(std::sqrt(f.squaredNorm())) {
  if (width == 0 || width > k_ || (width & (width - 1)) != 0)
    throw InvalidParamsError("bins of " + std::to_string(width) + " of " + std::to_string(k_) +
                             " samples: not a power of two within them");
  double sum = 0.0;
  std::size_t length = 0;
  for (std::size_t i = 0; i < k_; ++i) {
    length = f.isValid(i) ? length + 1 : 0;
    sum = length == 0 ? 0.0 : sum + static_cast<double>(f.samples()[i]);
    if (length < width) continue;
    const std::size_t start = i + 1 - width;
    starts_.push_back(static_cast<std::uint32_t>((start + rotations_.first) % k_));
    means_.push_back(static_cast<float>(sum / static_cast<double>(width)));
    length = 0;
    sum = 0.0;
  }
}

double BinMeansBound::operator()(const SampledPolarFunction& g, double reach) const {
  if (g.size() != k_)
    throw InvalidParamsError("views of " + std::to_string(k_) + " and " + std::to_string(g.size()) +
                             " samples cannot be compared");
  if (!g.isComplete())
    throw InvalidParamsError("a view with unseen directions is not bounded by bin means");
  if (starts_.empty()) return 0.0;
  thread_local std::vector<float> memory;
  memory.resize(4 * k_ + kRun);
  const float* const means = slidingMeans(g.samples().data(), k_, static_cast<float>(reach), width_,
                                          memory.data(), memory.data() + 2 * k_);
  const float least =
      leastSum(means, rotations_.count, starts_.data(), means_.data(), starts_.size());
  const double weight = kTwoPi * static_cast<double>(width_) / static_cast<double>(k_);
  const double slack = kRounding * (norm_ + std::sqrt(g.squaredNorm()));
  return std::max(0.0, std::sqrt(weight * static_cast<double>(least)) - slack);
}

}  // namespace mrpt_polyloc
