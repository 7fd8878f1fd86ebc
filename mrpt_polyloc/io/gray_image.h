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

/// Reads an image, whose kind is told by its first bytes, whatever its name: PGM or PPM, PNG, and
/// through MRPT BMP, JPEG and TIFF, of which colours are taken by their luminance.
/// \throws FormatError naming the file and what is wrong or missing, or that its kind is not known.
GrayImage loadImage(const std::string& path);

/// Reads a netpbm image of bytes: PGM, plain (P2) or binary (P5), PPM (P3, P6), up to 65535 levels,
/// with comments.
/// \param path of the file, for messages
/// \throws FormatError naming the file and what is wrong or missing.
GrayImage decodePgm(const std::string& path, const std::string& data);

/// Reads a PNG image of any colour type, its levels as they are stored: map_server's images mean
/// levels, not light, so gamma and colour profiles do not matter.
/// \param path of the file, for messages
/// \throws FormatError naming the file and what is wrong or missing.
GrayImage decodePng(const std::string& path, const std::string& data);

}  // namespace mrpt_polyloc
