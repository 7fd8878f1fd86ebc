#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// How much of a pixel is seen.
enum class Opacity : std::uint8_t { transparent, partial, opaque };

/// An image as map_server sees it: one brightness per pixel, row 0 at the top.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::uint32_t max_value = 0;        ///< of a white pixel
  std::vector<std::uint32_t> values;  ///< the sum over the colours, row by row
  std::vector<Opacity> opacity;       ///< empty if the image has no alpha channel
};

/// Reads a PGM file, plain (P2) or binary (P5), up to 65535 levels, with comments.
/// \throws FormatError naming the file and what is wrong or missing.
GrayImage loadPgm(const std::string& path);

/// Reads a PNG file of any colour type.
/// \throws FormatError naming the file and what is wrong or missing.
GrayImage loadPng(const std::string& path);

}  // namespace mrpt_polyloc
