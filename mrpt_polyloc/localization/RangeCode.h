#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mrpt_polyloc {

/// Ranges as bytes on a logarithmic scale: code = kScale ln(1 + r / kUnit), rounded, at most 255.
/// A step is 3 cm at 1 m and 17 cm at 10 m: what a turn by half an angular bin does to a range also
/// grows with it.
struct RangeCode {
  static constexpr float kUnit = 1.0F;    ///< [m]
  static constexpr float kScale = 64.0F;  ///< codes per unit of the logarithm; 255 is 53 m

  static std::uint8_t encode(float range) {
    const float code = kScale * std::log1p(std::max(range, 0.0F) / kUnit) + 0.5F;
    return static_cast<std::uint8_t>(std::min(code, 255.0F));  // infinity too
  }
};

}  // namespace mrpt_polyloc
