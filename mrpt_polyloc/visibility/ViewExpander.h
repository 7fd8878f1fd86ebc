#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A piece of a triangulation edge as seen from a viewpoint: of the edge from vertex `right` to
/// vertex `left` (counterclockwise around the viewpoint) the part between the rays through the
/// vertices `right_limit` and `left_limit`. Where end and limit are one vertex, the end is seen.
struct POLYLOC_EXPORT VisibleEdge {
  std::int32_t right;
  std::int32_t left;
  std::int32_t right_limit;
  std::int32_t left_limit;
  bool is_wall;  ///< else an open edge, or the rim of the box
};

/// What is seen from a point, as pieces of edges in counterclockwise order.
struct POLYLOC_EXPORT View {
  TPoint2D viewpoint{0, 0};
  /// Where the view ends: walls, and the rim of the box where no wall stops it.
  std::vector<VisibleEdge> ends;
  /// Open edges through which a ray first leaves free space for unknown space.
  std::vector<VisibleEdge> open;
};

/// Finds views by triangular expansion (F. Bungiu, M. Hemmer, J. Hershberger, K. Huang, A.
/// Kroeller, "Efficient computation of visibility polygons", EuroCG 2014): from the face that holds
/// the viewpoint through clear and open edges, the cone of sight narrowed at each vertex passed.
/// Exact orientation predicates; an explicit stack, no recursion.
///
/// Cost: the number of (face, gap) pairs that the view passes; O(n) without holes, O(n h) at worst.
/// A viewpoint on an edge or vertex is moved into its face by 1e-9 of the way to the centroid.
///
/// Keeps its memory between calls: use one per thread.
class POLYLOC_EXPORT ViewExpander {
 public:
  /// \param stop_at_open end the view at open edges too: what is seen of free space
  explicit ViewExpander(const Triangulation& triangulation, bool stop_at_open = false)
      : triangulation_(&triangulation), stop_at_open_(stop_at_open) {}

  /// The view from a point, empty if it lies outside the box. Valid until the next call.
  const View& expand(const TPoint2D& viewpoint);

  const Triangulation& triangulation() const { return *triangulation_; }

 private:
  /// A part of an edge through which the view is still to be followed.
  struct Gap {
    std::int32_t face;         ///< on the viewpoint's side of the edge
    std::int32_t edge;         ///< of `face`
    std::int32_t right, left;  ///< vertices that limit the cone of sight
    bool has_left_free_space;  ///< an open edge was crossed on the way, outwards
  };
  void follow(Gap gap);

  const Triangulation* triangulation_;
  bool stop_at_open_;
  View view_;
  std::vector<Gap> stack_;
};

}  // namespace mrpt_polyloc
