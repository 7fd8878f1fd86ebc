#pragma once

#include <mrpt_polyloc/geometry/bitmap_regions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Lattice points are counted in half cells, so that midpoints of cell sides are lattice points.
constexpr std::int32_t kLatticePerCell = 2;

/// A point on the border of cells: (2 x, 2 y) is the lower left corner of cell (x, y).
struct LatticePoint {
  std::int32_t x;
  std::int32_t y;
};
inline bool operator==(const LatticePoint& a, const LatticePoint& b) {
  return a.x == b.x && a.y == b.y;
}

/// A number that no other point has.
inline std::uint64_t latticeKey(const LatticePoint& p) {
  return static_cast<std::uint64_t>(p.y) << 32 | static_cast<std::uint32_t>(p.x);
}

/// Twice the signed area of a triangle: positive where a, b, c turn to the left. Exact.
inline std::int64_t cross(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
  return static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) -
         static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
}

/// A piece of border with one region on its left and one on its right all along: either between
/// two nodes (corners where more than two borders meet), or closed (first point == last point).
/// A free region, if there is one, lies to the left.
struct BorderChain {
  std::size_t begin;  ///< of its points in BorderChains::points
  std::size_t end;
  std::int32_t left;  ///< regions as in RegionGrid
  std::int32_t right;
};

/// All borders of a bitmap. Chains meet at their ends only.
struct BorderChains {
  std::vector<LatticePoint> points;
  std::vector<BorderChain> chains;

  const LatticePoint& first(const BorderChain& chain) const { return points[chain.begin]; }
  const LatticePoint& last(const BorderChain& chain) const { return points[chain.end - 1]; }
  bool isClosed(const BorderChain& chain) const { return first(chain) == last(chain); }
};

/// Follows the sides between cells of different regions; points are the ends and the corners where
/// the border turns. Chains between nodes come first, then the free-standing closed ones, each
/// group in the order of the first point (row by row).
BorderChains traceBorders(const RegionGrid& grid);

}  // namespace mrpt_polyloc
