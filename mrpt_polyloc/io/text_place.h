#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

namespace mrpt_polyloc {

/// "line L, column C" of a byte of a text, both counted from 1.
inline std::string textPlace(const std::string& text, std::size_t offset) {
  const std::size_t end = std::min(offset, text.size());
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t line_break = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t line_start = line_break == std::string::npos ? 0 : line_break + 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(end - line_start + 1);
}

}  // namespace mrpt_polyloc
