#pragma once

#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/geometry/BoundingBox.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <array>
#include <cstddef>
#include <memory>

namespace mrpt_polyloc {

/// Angular bins of the circle: bin b holds the directions [b, b + 1) kBandBinWidth of the map.
constexpr std::size_t kBandBins = 180;
constexpr double kBandBinWidth = kTwoPi / static_cast<double>(kBandBins);  ///< [rad]

/// For every angular bin, bounds of what is predicted from all points of a leaf in all directions
/// of the bin [m]: of the range to the first wall, and of the range at which an open edge is met
/// (infinity: none may be, or not from everywhere). Where a nearer wall ends within a bin, the
/// ranges have a gap: no wall and no open edge is met first between gap_low and gap_high (the
/// widest gap; both 0: none).
struct RangeBands {
  std::array<float, kBandBins> wall_low, wall_high;
  std::array<float, kBandBins> gap_low, gap_high;
  std::array<float, kBandBins> open_low, open_high;
  bool has_open = false;  ///< whether an open edge may be seen at all
};

/// Finds the range bands of convex polygons, the leaves, rigorous on both sides.
///
/// *Least range* (the first hit is not farther than any point of an obstacle on the ray): over the
/// edges e that face the leaf C from some point of it, the least distance from 0 in a bin of the
/// Minkowski difference e - C, which lies beyond the line of e as near as C comes to it and within
/// the differences' box. *Greatest range*: a chain of edges blocks a bin for all of C if, seen from
/// every point of it, the chain begins before the bin and ends after it (the directions of its
/// points are continuous along it); then some edge of it that faces the point is hit, and no such
/// edge reaches farther in the bin than the same bounds from outside allow. The bin's greatest
/// range is the least over all blocking stretches of chains. *Gap*: each edge that faces the leaf
/// is hit in the bin between the same two bounds only; the widest stretch between the least and the
/// greatest range that no edge's bounds reach into.
///
/// Holds for points at least some micrometres away from all vertices of the map.
class RangeBandFinder {
 public:
  /// Keeps a reference to the index.
  explicit RangeBandFinder(const VisibleEdgeIndex& index);
  ~RangeBandFinder();

  /// Looks through what is listed for the middle of a block (within one square of the index):
  /// leaves within it are then bounded by what may be seen from it alone, which is less. What is
  /// left out lies behind walls that block its bins from everywhere in the block, or, where none
  /// does, so far away that it hardly bounds anything: there may be anything then. Borders may
  /// cross the block: their edges within it stay, and block nothing.
  void narrow(const BoundingBox& block);

  /// \param leaf convex, counterclockwise, at most kMostVertices vertices, not crossed by a border,
  /// within one square of the index [m]; `count` vertices
  /// Keeps its memory between calls: use one finder per thread. O(listed edges * count + bins
  /// covered).
  void find(const TPoint2D* leaf, std::size_t count, RangeBands& bands);

 private:
  struct Workspace;
  const VisibleEdgeIndex* index_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace mrpt_polyloc
