#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// A bitmap of the given size whose cells are all alike; cells of 1 m at the origin.
inline OccupancyBitmap uniformBitmap(int width, int height, CellState state) {
  OccupancyBitmap bitmap;
  bitmap.width = width;
  bitmap.height = height;
  bitmap.resolution = 1.0;
  bitmap.cells.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), state);
  return bitmap;
}

inline CellState& cellAt(OccupancyBitmap& bitmap, int column, int row) {
  return bitmap.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(bitmap.width) +
                      static_cast<std::size_t>(column)];
}

/// A bitmap as drawn, the top line its highest row: '.' free, '#' occupied, '?' unknown. Cells of
/// 1 m at the origin.
inline OccupancyBitmap bitmapFromArt(const std::vector<std::string>& lines) {
  const auto height = static_cast<int>(lines.size());
  const auto width = lines.empty() ? 0 : static_cast<int>(lines.front().size());
  OccupancyBitmap bitmap = uniformBitmap(width, height, CellState::unknown);
  for (int row = 0; row < height; ++row) {
    const std::string& line = lines[static_cast<std::size_t>(height - 1 - row)];
    if (static_cast<int>(line.size()) != width) throw std::invalid_argument("ragged art: " + line);
    for (int column = 0; column < width; ++column) {
      const char c = line[static_cast<std::size_t>(column)];
      if (c != '.' && c != '#' && c != '?') throw std::invalid_argument("bad art: " + line);
      cellAt(bitmap, column, row) = c == '.'   ? CellState::free
                                    : c == '#' ? CellState::occupied
                                               : CellState::unknown;
    }
  }
  return bitmap;
}

/// Drawn as bitmapFromArt() reads it.
inline std::string toArt(const OccupancyBitmap& bitmap) {
  std::string art;
  for (int row = bitmap.height - 1; row >= 0; --row) {
    for (int column = 0; column < bitmap.width; ++column) {
      const CellState state = bitmap.at(column, row);
      art += state == CellState::free ? '.' : state == CellState::occupied ? '#' : '?';
    }
    art += '\n';
  }
  return art;
}

/// Every cell drawn for itself, with the given shares of free and occupied cells.
inline OccupancyBitmap noiseBitmap(int width, int height, double free_share, double occupied_share,
                                   std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  OccupancyBitmap bitmap = uniformBitmap(width, height, CellState::unknown);
  for (CellState& cell : bitmap.cells) {
    const double draw = uniform(random);
    if (draw < free_share)
      cell = CellState::free;
    else if (draw < free_share + occupied_share)
      cell = CellState::occupied;
  }
  return bitmap;
}

/// Discs and boxes of random states painted over one another: smooth, slanted and thin shapes.
inline OccupancyBitmap blobBitmap(int width, int height, int blobs, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&random](int below) {
    return std::uniform_int_distribution<int>(0, below - 1)(random);
  };
  OccupancyBitmap bitmap = uniformBitmap(width, height, CellState::unknown);
  for (int i = 0; i < blobs; ++i) {
    const int cx = draw(width);
    const int cy = draw(height);
    const int a = 1 + draw(width / 3 + 1);
    const int b = 1 + draw(height / 3 + 1);
    const int shape = draw(3);
    const auto state = static_cast<CellState>(draw(3));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int dx = x - cx;
        const int dy = y - cy;
        const bool disc = dx * dx + dy * dy <= a * b;
        const bool box = 2 * std::abs(dx) <= a && 2 * std::abs(dy) <= b;
        const bool slanted = std::abs(a * dx - b * dy) <= a + b && std::abs(dx) + std::abs(dy) <= a;
        if (shape == 0 ? disc : shape == 1 ? box : slanted) cellAt(bitmap, x, y) = state;
      }
    }
  }
  return bitmap;
}

}  // namespace mrpt_polyloc::test
