#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace mrpt_polyloc::test {

/// |a - b| of two Fourier features of one order: the lower bound of the metric.
inline double featureDistance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace mrpt_polyloc::test
