#pragma once

#include <cstdint>

namespace mrpt_polyloc {

/// Interleaves the bits of column and row: blocks of any level are then runs in this order.
inline std::uint64_t mortonCode(std::uint32_t column, std::uint32_t row) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 32; ++bit) {
    code |= static_cast<std::uint64_t>((column >> bit) & 1U) << (2 * bit);
    code |= static_cast<std::uint64_t>((row >> bit) & 1U) << (2 * bit + 1);
  }
  return code;
}

}  // namespace mrpt_polyloc
