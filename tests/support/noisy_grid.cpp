#include "noisy_grid.h"

#include "bitmap_art.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mrpt_polyloc::test {
namespace {

/// Paints onto a bitmap; everything outside of it is ignored.
class Painter {
 public:
  Painter(OccupancyBitmap& bitmap, std::uint32_t seed) : bitmap_(bitmap), random_(seed) {}

  int draw(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  bool chance(double share) { return std::bernoulli_distribution(share)(random_); }
  int anyColumn() { return draw(0, bitmap_.width - 1); }
  int anyRow() { return draw(0, bitmap_.height - 1); }

  void paint(int column, int row, CellState state) {
    if (column < 0 || row < 0 || column >= bitmap_.width || row >= bitmap_.height) return;
    cellAt(bitmap_, column, row) = state;
  }

  void disc(int column, int row, int radius, CellState state) {
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        if (dx * dx + dy * dy <= radius * radius) paint(column + dx, row + dy, state);
      }
    }
  }

  /// A box turned by `angle` about its lower left corner.
  void box(int column, int row, int width, int height, double angle, CellState state) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const int reach = width + height;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const double u = c * dx + s * dy;
        const double v = -s * dx + c * dy;
        if (u >= 0 && u < width && v >= 0 && v < height) paint(column + dx, row + dy, state);
      }
    }
  }

 private:
  OccupancyBitmap& bitmap_;
  std::mt19937 random_;
};

void paintRoom(Painter& painter, int column, int row, int size) {
  const double angle = painter.chance(0.3) ? 0.01 * painter.draw(-20, 20) : 0.0;
  const int width = size - painter.draw(4, 30);
  const int height = size - painter.draw(4, 30);
  painter.box(column, row, width, height, angle, CellState::occupied);
  painter.box(column + 3, row + 3, width - 6, height - 6, angle, CellState::free);
  for (int i = painter.draw(1, 5); i > 0; --i) {
    painter.box(column + painter.draw(5, size), row + painter.draw(5, size), painter.draw(2, 40),
                painter.draw(2, 20), 0.01 * painter.draw(0, 150), CellState::occupied);
  }
}

}  // namespace

OccupancyBitmap noisyGrid(int width, int height, std::uint32_t seed) {
  OccupancyBitmap bitmap = uniformBitmap(width, height, CellState::unknown);
  bitmap.resolution = 0.05;
  Painter painter(bitmap, seed);
  constexpr int kRoom = 120;
  for (int row = 10; row + kRoom < height; row += kRoom) {
    for (int column = 10; column + kRoom < width; column += kRoom) {
      if (painter.chance(0.85)) paintRoom(painter, column, row, kRoom);
      painter.box(column + kRoom - 30, row + painter.draw(20, 80), 50, 20, 0.0, CellState::free);
      painter.box(column + painter.draw(20, 80), row + kRoom - 30, 20, 50, 0.0, CellState::free);
    }
  }
  const int cells = width * height;
  for (int i = cells / 3000; i > 0; --i) {
    painter.disc(painter.anyColumn(), painter.anyRow(), painter.draw(1, 6), CellState::unknown);
  }
  // Ragged borders and specks: what the noise hits takes the state of a cell next to it, or turns.
  for (int i = cells / 60; i > 0; --i) {
    const int column = painter.anyColumn();
    const int row = painter.anyRow();
    painter.paint(column, row, bitmap.at(column + painter.draw(-2, 2), row + painter.draw(-2, 2)));
  }
  for (int i = cells / 100; i > 0; --i) {
    const auto state = painter.chance(0.7) ? CellState::occupied : CellState::unknown;
    painter.paint(painter.anyColumn(), painter.anyRow(), state);
  }
  return bitmap;
}

}  // namespace mrpt_polyloc::test
