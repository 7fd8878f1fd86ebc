#pragma once

#include <mrpt_polyloc/localization/search/RangeBands.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>
#include <mrpt_polyloc/visibility/fast_atan2.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Of each edge of a run, in columns: the lines that bound the Minkowski difference of it and the
/// leaf. With u the direction of a ray, the ray enters it at an inverse range of at most the least
/// `near` bound, and leaves it at one of at least the greatest `far` bound.
struct EdgeColumns {
  std::vector<float> nx, ny;                  ///< normal of the edge's line, away from the leaf
  std::vector<float> near_n, far_n;           ///< 1 / its least and greatest distance from the leaf
  std::vector<float> near_x, far_x;           ///< bounds are near_x * u.x ...
  std::vector<float> near_y, far_y;           ///< ... and near_y * u.y; 0 where they say nothing
  std::vector<float> skip_n, skip_x, skip_y;  ///< kUnbounded where the near bound says nothing
  std::vector<std::int32_t> faces;            ///< whether the edge faces some point of the leaf
  /// Bins, counted from the turn in which its first vertex is seen: those that the edge may be seen
  /// in from the leaf, whether its second vertex is a turn on or back, up to where that is past a
  /// bin from all of the leaf, and from where on it is before one.
  std::vector<std::int32_t> first, last, turn, past, before;

  void resize(std::size_t count) {
    for (auto* column :
         {&nx, &ny, &near_n, &far_n, &near_x, &far_x, &near_y, &far_y, &skip_n, &skip_x, &skip_y}) {
      column->resize(count);
    }
    for (auto* column : {&faces, &first, &last, &turn, &past, &before}) column->resize(count);
  }
};

/// Edges as they are seen from a leaf: the runs' vertices around its middle, the bins that each
/// edge may be seen in, and the lines that bound its ranges. Everything in columns, which keep
/// their memory, for all of it is computed as vectors.
struct EdgeBounds {
  static constexpr float kUnbounded = 1e9F;  ///< an inverse range that bounds nothing [1/m]

  /// A run: its vertices in the layout from `first` on are begin to end - 1 in the columns.
  struct Stretch {
    std::size_t first, begin, end;
  };
  std::vector<Stretch> stretches;
  std::vector<float> x, y;           ///< the runs' vertices, relative to the leaf's middle [m]
  std::vector<float> bearing;        ///< from the middle
  std::vector<float> before, after;  ///< of the middle's bearing, by how much others differ
  EdgeColumns edges;
  std::vector<TPoint2D> leaf;                          ///< relative to the middle
  float low_x = 0, high_x = 0, low_y = 0, high_y = 0;  ///< of the leaf

  /// \param vertices of a leaf, convex, or of a block, `count` of them [m]
  void takeLeaf(const TPoint2D* vertices, std::size_t count, const TPoint2D& middle);

  /// Whether runs are taken as they are listed, or with some edges more at both ends.
  enum class Ends { as_listed, extended };
  /// Bounds the edges of runs, one run after another, from the leaf taken before.
  void take(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs,
            const TPoint2D& middle, Ends ends);

  /// Whether the edge from vertex i may meet the leaf itself, here a block, or touches its box.
  POLYLOC_INLINE bool isWithin(std::size_t i) const {
    constexpr float kMargin = 1e-3F;
    return std::min(x[i], x[i + 1]) < high_x + kMargin &&
           std::max(x[i], x[i + 1]) > low_x - kMargin &&
           std::min(y[i], y[i + 1]) < high_y + kMargin &&
           std::max(y[i], y[i + 1]) > low_y - kMargin;
  }

 private:
  std::size_t gather(const BoundaryChains& chains, const std::vector<BoundaryChains::Run>& runs,
                     const TPoint2D& middle, Ends ends);
  void takeBearings(std::size_t count);
  void takeBins(std::size_t count);
  void boundEdges(std::size_t count);
};

}  // namespace mrpt_polyloc
