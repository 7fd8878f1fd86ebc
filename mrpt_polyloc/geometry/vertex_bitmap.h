#pragma once

#include <mrpt_polyloc/geometry/border_chains.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A set of lattice points with a fast exact test whether a triangle is free of them: one bit per
/// point, a row of the triangle is looked at 64 points at a time.
class VertexBitmap {
 public:
  /// For points with 0 <= x < columns, 0 <= y < rows.
  VertexBitmap(std::int32_t columns, std::int32_t rows)
      : words_per_row_((static_cast<std::size_t>(columns) + 63) / 64),
        words_(words_per_row_ * static_cast<std::size_t>(rows), 0) {}

  void insert(const LatticePoint& p) { word(p) |= bit(p); }
  void erase(const LatticePoint& p) { word(p) &= ~bit(p); }

  /// Whether a point of the set other than the triangle's own corners, which are in the set, lies
  /// in the triangle or on its border.
  bool hasOtherIn(const std::array<LatticePoint, 3>& triangle);

 private:
  static std::uint64_t bit(const LatticePoint& p) { return std::uint64_t{1} << (p.x % 64); }
  std::uint64_t& word(const LatticePoint& p) {
    return words_[static_cast<std::size_t>(p.y) * words_per_row_ +
                  static_cast<std::size_t>(p.x) / 64];
  }
  bool hasAnyIn(const std::array<LatticePoint, 3>& triangle) const;
  bool hasAnyInRow(std::int32_t y, std::int64_t from, std::int64_t to) const;

  std::size_t words_per_row_;
  std::vector<std::uint64_t> words_;
};

}  // namespace mrpt_polyloc
