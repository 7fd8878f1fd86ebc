#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// For every square cell of a grid over the free space, the edges that may be seen from some point
/// of it: a superset, so that a depth buffer over the list gives the exact view.
///
/// Found by expansion as for a point (ViewExpander), with "seen from some corner of the square" for
/// "seen": whether a vertex lies left of the ray from p through a limit is affine in p, so if it
/// holds for a point of the square, it holds for a corner. Each of the two limits is held against
/// its own best corner, which can only add edges. Built on several threads with one result.
class VisibleEdgeIndex {
 public:
  /// A directed edge: the viewer is on its left; endpoints relative to origin() [m].
  struct Edge {
    float ax, ay, bx, by;
  };
  /// A cell's corners.
  struct Square {
    std::array<TPoint2D, 4> corners;
  };
  /// Numbers of edges(): those of walls, then those of open edges seen from their free side.
  struct Cell {
    const std::uint32_t* walls;
    std::size_t wall_count;
    const std::uint32_t* open;
    std::size_t open_count;
  };

  /// \param cell_size side of the cells [m], > 0
  /// \param threads 0: all cores
  VisibleEdgeIndex(const Triangulation& triangulation, double cell_size, int threads = 0);

  /// Whether a point lies in a cell that is indexed: all cells that touch free space are, and those
  /// next to them.
  bool covers(const TPoint2D& point) const { return cellNumber(point) >= 0; }
  /// The number of the cell that holds a point (cells in a row are consecutive), -1 if not indexed.
  std::int64_t cellNumber(const TPoint2D& point) const;
  Cell cell(std::int64_t number) const;

  const std::vector<Edge>& edges() const { return edges_; }
  const TPoint2D& origin() const { return origin_; }
  std::size_t bytes() const;

 private:
  /// Calls visit(face, column, row) for each pair whose boxes overlap.
  template <class Visitor>
  void forEachOverlap(const Triangulation& t, Visitor&& visit) const;
  Square square(int column, int row) const;
  void numberLists(const Triangulation& t);
  void buildLists(const Triangulation& t, int threads);
  void flatten(const Triangulation& t, const std::vector<std::vector<std::uint32_t>>& walls,
               const std::vector<std::vector<std::uint32_t>>& open);

  TPoint2D corner_;  ///< lower left, of cell (0, 0)
  TPoint2D origin_;
  double cell_size_;
  int columns_, rows_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> list_of_cell_;  ///< number of the cell's lists, -1 if not indexed
  std::vector<std::uint32_t> list_begin_;   ///< into list_: walls at 2 i, open edges at 2 i + 1
  std::vector<std::uint32_t> list_;
};

}  // namespace mrpt_polyloc
