#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mrpt_polyloc {

/// Ranges as bytes, in one of several units, so that near walls are told finely and far ones still
/// are. Rounded so that what is bounded is bounded still: the least range of a band and the scan's
/// range that is held against its greatest down, the others up. All that is beyond the greatest
/// byte counts as that: it costs nothing there.
struct QuantizedRange {
  static constexpr std::size_t kScales = 5;
  static constexpr double kFinestUnit = 1.0 / 32;  ///< [m]
  static constexpr int kGreatest = 255;
  static constexpr double kReach = kGreatest * kFinestUnit * (1U << (kScales - 1));  ///< [m]

  /// [m]: 1/32 to 1/2, so that bytes reach 8 to 127 m.
  static constexpr double unit(std::size_t scale) {
    return kFinestUnit * static_cast<double>(1U << scale);
  }
  static std::uint8_t down(double range, std::size_t scale) {
    return clamped(std::floor(range / unit(scale)));
  }
  static std::uint8_t up(double range, std::size_t scale) {
    return clamped(std::ceil(range / unit(scale)));
  }

 private:
  static std::uint8_t clamped(double units) {
    return static_cast<std::uint8_t>(std::clamp(units, 0.0, static_cast<double>(kGreatest)));
  }
};

}  // namespace mrpt_polyloc
