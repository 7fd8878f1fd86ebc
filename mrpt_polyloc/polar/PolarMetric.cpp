#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace mrpt_polyloc {

namespace {

void checkSameSize(const SampledPolarFunction& f, const SampledPolarFunction& g) {
  if (f.size() != g.size())
    throw InvalidParamsError("views of " + std::to_string(f.size()) + " and " +
                             std::to_string(g.size()) + " samples cannot be compared");
}

// Sums and maxima run in lanes of their own, so that the compiler may vectorise them without
// reordering.
constexpr std::size_t kLanes = 8;

double total(const std::array<double, kLanes>& lanes) {
  double sum = 0.0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

/// Sum of (f_i - g_i)^2 over n samples.
POLYLOC_HOT_LOOP
double squaredDifference(const float* f, const float* g, std::size_t n) {
  std::array<double, kLanes> lanes{};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double e = static_cast<double>(f[i + lane]) - static_cast<double>(g[i + lane]);
      lanes[lane] += e * e;
    }
  for (; i < n; ++i) {
    const double e = static_cast<double>(f[i]) - static_cast<double>(g[i]);
    lanes[0] += e * e;
  }
  return total(lanes);
}

/// Sum of m_i (f_i - g_i)^2 over n samples.
POLYLOC_HOT_LOOP
double maskedSquaredDifference(const float* f, const float* g, const float* mask, std::size_t n) {
  std::array<double, kLanes> lanes{};
  std::size_t i = 0;
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double e = static_cast<double>(f[i + lane]) - static_cast<double>(g[i + lane]);
      lanes[lane] += static_cast<double>(mask[i + lane]) * e * e;
    }
  for (; i < n; ++i) {
    const double e = static_cast<double>(f[i]) - static_cast<double>(g[i]);
    lanes[0] += static_cast<double>(mask[i]) * e * e;
  }
  return total(lanes);
}

/// The greatest of n > 0 numbers.
POLYLOC_HOT_LOOP
float greatest(const float* values, std::size_t n) {
  constexpr std::size_t kWide = 32;
  std::array<float, kWide> lanes;
  lanes.fill(values[0]);
  std::size_t i = 0;
  for (; i + kWide <= n; i += kWide)
    for (std::size_t lane = 0; lane < kWide; ++lane)
      lanes[lane] = values[i + lane] > lanes[lane] ? values[i + lane] : lanes[lane];
  for (; i < n; ++i) lanes[0] = values[i] > lanes[0] ? values[i] : lanes[0];
  float best = lanes[0];
  for (const float lane : lanes) best = lane > best ? lane : best;
  return best;
}

/// Sum_i (f_{i-s} - g_i)^2 over the valid samples of f; g is complete.
double squaredDifferenceTurned(const SampledPolarFunction& f, const SampledPolarFunction& g,
                               std::size_t s) {
  const std::size_t rest = f.size() - s;
  const float* const a = f.samples().data();
  const float* const b = g.samples().data();
  if (f.isComplete()) return squaredDifference(a, b + s, rest) + squaredDifference(a + rest, b, s);
  const float* const mask = f.mask().data();
  return maskedSquaredDifference(a, b + s, mask, rest) +
         maskedSquaredDifference(a + rest, b, mask + rest, s);
}

double toDistance(double squared_difference, std::size_t k) {
  return std::sqrt(kTwoPi / static_cast<double>(k) * std::max(squared_difference, 0.0));
}

/// -1/2 (g_i^2 - mean_square) for n samples. \returns the sum of their squares
POLYLOC_HOT_LOOP
double halvedSquares(const float* g, std::size_t n, double mean_square, float* squares) {
  std::array<double, kLanes> lanes{};
  std::size_t i = 0;
  const auto halved = [&](std::size_t j) {
    const double value = static_cast<double>(g[j]);
    const double square = -0.5 * (value * value - mean_square);
    squares[j] = static_cast<float>(square);
    return square * square;
  };
  for (; i + kLanes <= n; i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] += halved(i + lane);
  for (; i < n; ++i) lanes[0] += halved(i);
  return total(lanes);
}

/// For every rotation s: constant - Sum_i (f_{i-s} - g_i)^2 / 2, and how far it may be off by
/// rounding. The values belong to the calling thread, until it correlates again.
struct Gains {
  const float* values;
  double error;
};

Gains gainsOf(const SampledPolarFunction& f, const SampledPolarFunction& g) {
  const std::size_t k = f.size();
  const CirclePlan& plan = f.plan();
  Gains gains{};
  gains.error = plan.correlationError() * f.spectrumNorm() * g.spectrumNorm();
  if (f.isComplete()) {
    gains.values = plan.correlation(f.spectrum().data(), g.spectrum().data());
    return gains;
  }

  // Which samples of g are compared depends on the rotation, and so does the sum of their squares;
  // the constant part of the squares does not matter and would only cost digits.
  thread_local std::vector<float> squares;
  thread_local std::vector<std::complex<float>> spectrum;
  squares.resize(k);
  spectrum.resize(plan.spectrumSize());
  const double norm =
      halvedSquares(g.samples().data(), k, g.squaredNorm() / kTwoPi, squares.data());
  plan.spectrum(squares.data(), spectrum.data());
  gains.values = plan.correlation(f.spectrum().data(), g.spectrum().data(), f.maskSpectrum().data(),
                                  spectrum.data());
  gains.error += plan.correlationError() * std::sqrt(norm * static_cast<double>(f.validCount()));
  return gains;
}

/// Calls use(s) for all rotations of a range whose gain, of k, is within `margin` of the best.
template <class Use>
void forBestGains(const float* gains, std::size_t k, IndexRange range, double margin, Use use) {
  // The range as one or two runs without a wrap.
  const std::size_t head = std::min(range.count, k - range.first);
  float best = greatest(gains + range.first, head);
  if (head < range.count) best = std::max(best, greatest(gains, range.count - head));
  const auto threshold = static_cast<float>(static_cast<double>(best) - margin);
  const auto search = [&](std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = 32;  // most blocks hold none
    for (std::size_t i = begin; i < end; i += kBlock) {
      const std::size_t stop = std::min(i + kBlock, end);
      unsigned any = 0;
      for (std::size_t j = i; j < stop; ++j) any |= gains[j] >= threshold ? 1U : 0U;
      for (std::size_t j = i; any != 0 && j < stop; ++j)
        if (gains[j] >= threshold) use(j);
    }
  };
  search(range.first, range.first + head);
  search(0, range.count - head);
}

/// Where the parabola through the gains at -1, 0, 1 has its top, within half a step.
double parabolaOffset(double before, double at, double after) {
  const double curvature = 2.0 * at - before - after;
  return curvature > 0.0 ? std::clamp(0.5 * (after - before) / curvature, -0.5, 0.5) : 0.0;
}

/// distanceOverRotations() where g is complete.
RotationMatch matchAgainstComplete(const SampledPolarFunction& f, const SampledPolarFunction& g,
                                   const RotationRange& range) {
  const std::size_t k = f.size();
  const Gains gains = gainsOf(f, g);
  const IndexRange indices = indicesIn(range, k);
  RotationMatch match;
  double least = -1.0;
  // Both the best gain and any other may be off, by the error of the sum and of the threshold.
  forBestGains(gains.values, k, indices, 4.0 * gains.error, [&](std::size_t s) {
    const double value = squaredDifferenceTurned(f, g, s);
    if (least >= 0.0 && (value > least || (value == least && s > match.index))) return;
    least = value;
    match.index = s;
  });
  const double step = kTwoPi / static_cast<double>(k);
  const auto gainAt = [&](std::size_t s) { return static_cast<double>(gains.values[s % k]); };
  const double offset = step * parabolaOffset(gainAt(match.index + k - 1), gainAt(match.index),
                                              gainAt(match.index + 1));
  match.distance = toDistance(least, k);
  match.rotation = step * static_cast<double>(match.index);
  match.finer_rotation = wrapToTwoPi(match.rotation + offset);
  return match;
}

}  // namespace

double distance(const SampledPolarFunction& f, const SampledPolarFunction& g) {
  checkSameSize(f, g);
  const std::size_t k = f.size();
  const float* const a = f.samples().data();
  const float* const b = g.samples().data();
  if (f.isComplete() && g.isComplete()) return toDistance(squaredDifference(a, b, k), k);
  if (f.isComplete() || g.isComplete()) {
    const float* const mask = f.isComplete() ? g.mask().data() : f.mask().data();
    return toDistance(maskedSquaredDifference(a, b, mask, k), k);
  }
  std::vector<float> common(k);
  for (std::size_t i = 0; i < k; ++i) common[i] = f.mask()[i] * g.mask()[i];
  if (std::find(common.begin(), common.end(), 1.0F) == common.end())
    throw InvalidParamsError("the views have no valid sample in common");
  return toDistance(maskedSquaredDifference(a, b, common.data(), k), k);
}

RotationMatch distanceOverRotations(const SampledPolarFunction& f, const SampledPolarFunction& g,
                                    const RotationRange& range) {
  checkSameSize(f, g);
  range.check();
  if (g.isComplete()) return matchAgainstComplete(f, g, range);
  if (!f.isComplete())
    throw InvalidParamsError(
        "both views are partial: the rotation that leaves them least in common would win");
  RotationRange backward = range;
  backward.center = -range.center;
  RotationMatch match = matchAgainstComplete(g, f, backward);
  match.index = (f.size() - match.index) % f.size();
  match.rotation = kTwoPi * static_cast<double>(match.index) / static_cast<double>(f.size());
  match.finer_rotation = wrapToTwoPi(-match.finer_rotation);
  return match;
}

}  // namespace mrpt_polyloc
