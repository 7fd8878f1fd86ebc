#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/polar/BinMeansBound.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace mrpt_polyloc {
namespace {

// Of a sum of squares in single precision, some 20 terms deep, and of what it is the difference of.
constexpr double kRounding = 1e-5;

/// The means of `width` (a power of two) neighbours from each of k samples on, by doubling; twice
/// over, so that no index wraps. `means` has 2 k places.
POLYLOC_HOT_LOOP
void slidingMeans(const float* samples, std::size_t k, float reach, std::size_t width,
                  float* __restrict__ means) {
  for (std::size_t i = 0; i < k; ++i) means[i] = samples[i] < reach ? samples[i] : reach;
  for (std::size_t i = 0; i < k; ++i) means[k + i] = means[i];
  // In place: what is added lies ahead. The tail wraps no more than once, as width <= k.
  for (std::size_t step = 1; step < width; step *= 2) {
    const float* const ahead = means + step;
    for (std::size_t i = 0; i < k; ++i) means[i] = 0.5F * (means[i] + ahead[i]);
    for (std::size_t i = 0; i < k; ++i) means[k + i] = means[i];
  }
}

/// The least over n rotations of the summed squared differences of the bins' means.
POLYLOC_HOT_LOOP
float leastSum(const float* __restrict__ means, std::size_t n, const std::uint32_t* starts,
               const float* bin_means, std::size_t bins, float* __restrict__ sums) {
  for (std::size_t s = 0; s < n; ++s) sums[s] = 0.0F;
  for (std::size_t b = 0; b < bins; ++b) {
    const float* const run = means + starts[b];
    const float mean = bin_means[b];
    for (std::size_t s = 0; s < n; ++s) {
      const float e = run[s] - mean;
      sums[s] += e * e;
    }
  }
  constexpr std::size_t kLanes = 16;
  std::array<float, kLanes> lanes;
  lanes.fill(sums[0]);
  std::size_t s = 0;
  for (; s + kLanes <= n; s += kLanes) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes[i] = sums[s + i] < lanes[i] ? sums[s + i] : lanes[i];
    }
  }
  for (; s < n; ++s) lanes[0] = sums[s] < lanes[0] ? sums[s] : lanes[0];
  return *std::min_element(lanes.begin(), lanes.end());
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
  thread_local std::vector<float> means, sums;
  means.resize(2 * k_);
  sums.resize(k_);
  slidingMeans(g.samples().data(), k_, static_cast<float>(reach), width_, means.data());
  const float least = leastSum(means.data(), rotations_.count, starts_.data(), means_.data(),
                               starts_.size(), sums.data());
  const double weight = kTwoPi * static_cast<double>(width_) / static_cast<double>(k_);
  const double slack = kRounding * (norm_ + std::sqrt(g.squaredNorm()));
  return std::max(0.0, std::sqrt(weight * static_cast<double>(least)) - slack);
}

}  // namespace mrpt_polyloc
