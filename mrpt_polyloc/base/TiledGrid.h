#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Numbers of the squares of a large grid of which few are used: tiles of 64 x 64 squares, those
/// held that a square was put in. Memory follows what is used, not the grid (but for four bytes a
/// tile).
class TiledGrid {
 public:
  static constexpr int kSide = 64;           ///< squares
  static constexpr std::int32_t kNone = -1;  ///< what a square holds that was not put

  TiledGrid() = default;
  TiledGrid(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        tile_columns_((columns + kSide - 1) / kSide),
        tile_rows_((rows + kSide - 1) / kSide),
        tile_(static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_),
              kNone) {}

  int columns() const { return columns_; }
  int rows() const { return rows_; }

  std::int32_t at(int column, int row) const {
    const std::int32_t tile = tile_[tileOf(column, row)];
    return tile < 0 ? kNone : squares_[squareIn(tile, column, row)];
  }
  void put(int column, int row, std::int32_t value) {
    std::int32_t& tile = tile_[tileOf(column, row)];
    if (tile < 0) {
      tile = static_cast<std::int32_t>(squares_.size() / (kSide * kSide));
      squares_.resize(squares_.size() + kSide * kSide, kNone);
    }
    squares_[squareIn(tile, column, row)] = value;
  }

  /// Calls visit(column, row, value) for the squares put, row by row.
  template <class Visitor>
  void forEach(Visitor&& visit) const {
    forEachIn(0, columns_ - 1, 0, rows_ - 1, visit);
  }
  /// The same for those of some columns and rows, both ends included and within the grid.
  template <class Visitor>
  void forEachIn(int first_column, int last_column, int first_row, int last_row,
                 Visitor&& visit) const {
    for (int row = first_row; row <= last_row;) {
      bool has_tiles = false;
      for (int column = first_column; column <= last_column;) {
        const int next = (column / kSide + 1) * kSide;
        const std::int32_t tile = tile_[tileOf(column, row)];
        for (; tile >= 0 && column < next && column <= last_column; ++column) {
          const std::int32_t value = squares_[squareIn(tile, column, row)];
          if (value != kNone) visit(column, row, value);
        }
        has_tiles |= tile >= 0;
        column = next;
      }
      row = has_tiles ? row + 1 : (row / kSide + 1) * kSide;
    }
  }

  std::size_t bytes() const { return (tile_.size() + squares_.size()) * sizeof(std::int32_t); }

 private:
  std::size_t tileOf(int column, int row) const {
    return static_cast<std::size_t>(row / kSide) * static_cast<std::size_t>(tile_columns_) +
           static_cast<std::size_t>(column / kSide);
  }
  static std::size_t squareIn(std::int32_t tile, int column, int row) {
    return (static_cast<std::size_t>(tile) * kSide + static_cast<std::size_t>(row % kSide)) *
               kSide +
           static_cast<std::size_t>(column % kSide);
  }

  int columns_ = 0, rows_ = 0;
  int tile_columns_ = 0, tile_rows_ = 0;
  std::vector<std::int32_t> tile_;     ///< number of a tile's squares, kNone if it holds none
  std::vector<std::int32_t> squares_;  ///< tile by tile, in a tile row by row
};

}  // namespace mrpt_polyloc
