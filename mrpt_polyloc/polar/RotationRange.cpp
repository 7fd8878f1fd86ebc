#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/polar/RotationRange.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {

void RotationRange::check() const {
  constexpr double kMost = std::numeric_limits<double>::max();
  requireInRange("center", center, -kMost, kMost);
  requireInRange("tolerance", tolerance, 0.0, kPi);
}

IndexRange indicesIn(const RotationRange& range, std::size_t k) {
  range.check();
  if (range.isFullCircle()) return {0, k};
  const double per_radian = static_cast<double>(k) / kTwoPi;
  const double center = wrapToTwoPi(range.center) * per_radian;
  const double reach = range.tolerance * per_radian + 1e-9;  // bounds meant to be on the grid are
  const double first = std::ceil(center - reach), last = std::floor(center + reach);
  const auto size = static_cast<double>(k);
  if (last < first) return {static_cast<std::size_t>(std::llround(center)) % k, 1};
  return {static_cast<std::size_t>(first < 0.0 ? first + size : first) % k,
          std::min(k, static_cast<std::size_t>(last - first) + 1)};
}

}  // namespace mrpt_polyloc
