#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// An axis-parallel square.
struct Square {
  TPoint2D center;
  double half;  ///< of its side [m]
};

/// Finds what may be seen from some point of a square, by expansion as for a point (ViewExpander)
/// with "from some point of the square" for "from the point": a superset, for each limit of the
/// cone of sight is held against its own best point of the square.
///
/// Whether x lies left of the ray from p through a limit r is the sign of an affine function of p;
/// with r, x and p relative to the centre its extremes over the square are
/// r.x * x.y - r.y * x.x +- half * (|x.x - r.x| + |x.y - r.y|).
///
/// Keeps its memory between calls: use one per thread.
class SquareExpander {
 public:
  using HalfEdge = std::uint32_t;  // 3 * face + edge

  explicit SquareExpander(const Triangulation& t) : t_(&t), visits_(3 * t.faces().size()) {}

  /// The walls and the other edges that may be reached from inside their faces; of the latter those
  /// with passage open. `faces` are those that overlap the square. In no order.
  void expand(const Square& square, const std::vector<std::int32_t>& faces,
              std::vector<HalfEdge>& walls, std::vector<HalfEdge>& open);

 private:
  /// Limits of a cone of sight on one side: two vertices, or one twice. Which of two is the tighter
  /// one may depend on the point of the square, then both are kept.
  using Limits = std::array<std::int32_t, 2>;
  struct Gap {
    HalfEdge edge;
    Limits right, left;
    bool operator==(const Gap& other) const { return right == other.right && left == other.left; }
  };
  /// The cones by which a half edge was reached: up to kCones different ones; after that the widest
  /// possible cone, that of the edge itself, stands for all. Bounds the work where many holes offer
  /// many ways.
  static constexpr int kCones = 3;
  struct Visits {
    int count = 0;
    std::array<Gap, kCones> cones{};
  };

  TPoint2D at(std::int32_t v) const {
    return t_->vertices()[static_cast<std::size_t>(v)] - square_.center;
  }
  bool someLeft(const TPoint2D& limit, const TPoint2D& x) const;
  bool someLeft(const Limits& limits, const TPoint2D& x) const;
  bool someRight(const Limits& limits, const TPoint2D& x) const;
  Limits tightened(const Limits& limits, std::int32_t apex, bool right) const;
  void push(Gap gap);
  void follow(const Gap& gap);

  const Triangulation* t_;
  Square square_{{0, 0}, 0};
  std::vector<HalfEdge>* walls_ = nullptr;
  std::vector<HalfEdge>* open_ = nullptr;
  std::vector<Visits> visits_;
  std::vector<HalfEdge> touched_;
  std::vector<Gap> stack_;
};

}  // namespace mrpt_polyloc
