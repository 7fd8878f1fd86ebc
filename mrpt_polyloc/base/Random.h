#pragma once

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/export.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace mrpt_polyloc {

/// Random numbers from mt19937_64, which the standard fixes, through transformations of our own,
/// which it leaves to the library: the same seed gives the same numbers everywhere.
class POLYLOC_EXPORT Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  /// Standard normal, by Box and Muller; two draws each time, so that streams stay aligned.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log1p(-unit()));
    return radius * std::cos(2.0 * kPi * unit());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace mrpt_polyloc
