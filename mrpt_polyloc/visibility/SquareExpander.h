#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// An axis-parallel square.
struct Square {
  TPoint2D center;
  double half;  ///< of its side [m]
};

/// Finds what may be seen from some point of a square, by expansion as for a point (ViewExpander)
/// with "from some point of the square" for "from the point": a superset, for each limit of the
/// cone of sight is held against its own best point of the square, and the cones that reach an edge
/// by several ways (around holes) are joined.
///
/// Whether x lies left of the ray from p through a limit r is the sign of an affine function of p;
/// with r, x and p relative to the centre its extremes over the square are
/// r.x * x.y - r.y * x.x +- half * (|x.x - r.x| + |x.y - r.y|).
///
/// Faces are entered near ones first (by the power of the centre to their circles, which is an
/// order of visibility in a Delaunay triangulation; in steps, for a queue is as fast as it is
/// coarse), so that an edge is mostly followed once, with all the cones that reach it.
///
/// What lies in unknown space is seen up to a horizon only: so far behind the first open edge by
/// which a ray leaves free space, whatever it passes there. Without it nearly every wall of a map
/// with holes is seen from nearly everywhere. From a point in unknown space one sees less far,
/// unless through free space, where a ray begins anew.
///
/// Keeps its memory between calls: use one per thread.
class SquareExpander {
 public:
  using HalfEdge = std::uint32_t;  // 3 * face + edge

  /// How far from a square in unknown space walls are seen without passing free space [m]: allowed
  /// poses lie beside free space and look into it.
  static constexpr double kHorizonOutside = 3.0;

  /// \param horizon how far behind the first open edge walls are seen [m]
  SquareExpander(const Triangulation& triangulation, double horizon);

  /// What may be seen, in no order: walls, from the side of their face, and the open edges by which
  /// rays first leave free space. `faces` are those that overlap the square.
  void expand(const Square& square, const std::vector<std::int32_t>& faces,
              std::vector<HalfEdge>& walls, std::vector<HalfEdge>& open);

 private:
  /// Limits of a cone of sight on one side: two vertices, or one twice. Which of two is the tighter
  /// one may depend on the point of the square, then both are kept.
  using Limits = std::array<std::int32_t, 2>;
  struct Cone {
    Limits right, left;
  };
  /// How far from the centre rays see [m], and whether free space would let them see on.
  struct Reach {
    float horizon;  ///< infinity: they are in free space, and have been since they entered it
    bool is_from_outside;
  };
  /// What is known of a half edge: the cone by which it is passed.
  struct Passed {
    Cone cone{};
    Reach reach{};
    std::int32_t count = 0;  ///< how often the cone was set or widened
    bool is_waiting = false;
  };
  /// A face as the expansion needs it, in one cache line.
  struct Node {
    std::array<std::int32_t, 3> vertex;
    std::array<std::int32_t, 3> across;  ///< the same edge from its other side, or kEnd or kRim
    float x, y, squared_radius;          ///< of its circle, relative to the first vertex
    bool is_free;
  };
  static constexpr std::int32_t kEnd = -1;  ///< a wall
  static constexpr std::int32_t kRim = -2;  ///< of the box
  enum class Side { right, left };

  TPoint2D at(std::int32_t v) const {
    return t_->vertices()[static_cast<std::size_t>(v)] - square_.center;
  }
  bool isSeenPast(const Limits& limits, const TPoint2D& x, Side side) const;
  bool isWider(std::int32_t limit, const TPoint2D& x, Side side) const;
  Limits tightened(const Limits& limits, std::int32_t apex, Side side) const;
  Limits joined(const Limits& a, const Limits& b, std::int32_t end, Side side) const;
  static std::int32_t acrossOf(const Triangulation& t, std::size_t face, std::size_t i);
  float nearest(const TPoint2D& a, const TPoint2D& b) const;
  float farthest(const TPoint2D& a, const TPoint2D& b) const;
  Reach past(HalfEdge edge, const Reach& reach) const;
  void reach(HalfEdge edge, const Cone& cone, Reach reach);
  void wait(HalfEdge edge, std::int32_t across);
  void follow(HalfEdge edge);

  const Triangulation* t_;
  double horizon_;
  TPoint2D origin_{0, 0};
  std::vector<Node> nodes_;
  Square square_{{0, 0}, 0};
  float center_x_ = 0, center_y_ = 0;  ///< relative to the origin
  std::vector<HalfEdge>* walls_ = nullptr;
  std::vector<HalfEdge>* open_ = nullptr;
  std::vector<Passed> passed_;
  std::vector<HalfEdge> touched_;
  /// Half edges that wait, by how far their circle is, in steps of kStep: order within a step only
  /// saves work.
  std::vector<std::vector<HalfEdge>> queue_;
  std::size_t nearest_waiting_ = 0;  ///< nothing waits in steps below
};

}  // namespace mrpt_polyloc
