#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace mrpt_polyloc {

/// Appends the shortest decimal text that reads back as exactly this finite number, whatever the
/// locale; without exponent for numbers a map is likely to hold.
inline void appendNumber(std::string& text, double value) {
  char digits[40];  // the longest has 24 with an exponent, 33 without
  const double size = std::abs(value);
  const bool is_plain = size == 0.0 || (size >= 1e-6 && size < 1e15);
  const std::to_chars_result end =
      std::to_chars(digits, digits + sizeof digits, value,
                    is_plain ? std::chars_format::fixed : std::chars_format::scientific);
  text.append(digits, end.ptr);
}

}  // namespace mrpt_polyloc
