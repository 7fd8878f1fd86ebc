#pragma once

#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A corner of cells: corner (x, y) is the lower left one of cell (x, y).
struct Corner {
  std::int32_t x;
  std::int32_t y;
};
inline bool operator==(const Corner& a, const Corner& b) {
  return a.x == b.x && a.y == b.y;
}
inline bool operator!=(const Corner& a, const Corner& b) {
  return !(a == b);
}

/// Twice the signed area of a triangle: positive where a, b, c turn to the left. Exact.
inline std::int64_t cross(const Corner& a, const Corner& b, const Corner& c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
         static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

/// A piece of border with one region on its left and one on its right all along: either between
/// two nodes (corners where more than two borders meet), or closed (first corner == last corner).
/// A free region, if there is one, lies to the left.
struct BorderChain {
  std::size_t begin;  ///< of its corners in BorderChains::corners
  std::size_t end;
  std::int32_t left;  ///< regions as in RegionGrid
  std::int32_t right;
};

/// All borders of a bitmap. Chains meet at their ends only.
struct BorderChains {
  std::vector<Corner> corners;
  std::vector<BorderChain> chains;

  const Corner& first(const BorderChain& chain) const { return corners[chain.begin]; }
  const Corner& last(const BorderChain& chain) const { return corners[chain.end - 1]; }
  bool isClosed(const BorderChain& chain) const { return first(chain) == last(chain); }
};

/// Follows the sides between cells of different regions; corners are those where the border turns,
/// and the ends. Chains between nodes come first, then the free-standing closed ones, each group in
/// the order of the first corner (row by row).
BorderChains traceBorders(const RegionGrid& grid);

}  // namespace mrpt_polyloc
