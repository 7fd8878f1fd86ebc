#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace mrpt_polyloc::test {

/// Reads a binary PGM as an occupancy bitmap the way map_server does in its trinary mode (dark is
/// occupied); for tests that need real bitmaps below the layer that reads map files.
inline OccupancyBitmap readPgm(const std::string& path, double resolution,
                               double free_below = 0.196, double occupied_above = 0.65) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  std::size_t at = 0;
  const auto nextWord = [&] {
    while (at < bytes.size() && (std::isspace(bytes[at]) != 0 || bytes[at] == '#')) {
      if (bytes[at] == '#')
        at = bytes.find('\n', at);
      else
        ++at;
    }
    const std::size_t start = at;
    while (at < bytes.size() && std::isspace(bytes[at]) == 0) ++at;
    return bytes.substr(start, at - start);
  };
  if (nextWord() != "P5") throw std::runtime_error(path + ": not a binary PGM");
  OccupancyBitmap bitmap;
  bitmap.width = std::stoi(nextWord());
  bitmap.height = std::stoi(nextWord());
  bitmap.resolution = resolution;
  const double white = std::stod(nextWord());
  ++at;
  const auto width = static_cast<std::size_t>(bitmap.width);
  const auto height = static_cast<std::size_t>(bitmap.height);
  if (bytes.size() < at + width * height) throw std::runtime_error(path + ": truncated");
  bitmap.cells.resize(width * height);
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const char byte = bytes[at + (height - 1 - row) * width + column];
      const double occupancy = 1.0 - static_cast<unsigned char>(byte) / white;
      bitmap.cells[row * width + column] = occupancy > occupied_above ? CellState::occupied
                                           : occupancy < free_below   ? CellState::free
                                                                      : CellState::unknown;
    }
  }
  return bitmap;
}

}  // namespace mrpt_polyloc::test
