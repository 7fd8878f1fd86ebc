#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// All walls of a triangulation, each from both sides, and all open edges from their free side,
/// laid out as chains of vertices: an edge runs from its vertex to the next one in the layout, the
/// viewer on its left. Edges that follow each other along a border do so in the layout, so that
/// what is seen of a border is a run of the layout, and vertices are handled once, not twice.
///
/// Coordinates are fixed-point and relative to the box's centre: differences to a viewpoint are
/// exact, and only they are rounded to single precision.
class BoundaryChains {
 public:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
  /// So many vertices may be read beyond the last one: vector code handles whole blocks.
  static constexpr std::size_t kPadding = 16;

  /// Consecutive edges of one chain: vertices first to first + edges.
  struct Run {
    std::uint32_t first;
    std::uint32_t edges;
  };

  explicit BoundaryChains(const Triangulation& triangulation);

  /// Coordinates of the vertices in units of unit().
  const std::int32_t* x() const { return x_.data(); }
  const std::int32_t* y() const { return y_.data(); }
  std::size_t vertexCount() const { return is_edge_.size(); }
  double unit() const { return unit_; }  ///< [m], a power of two
  /// A coordinate of a point in the triangulated box, in the same units.
  std::int32_t fixedX(double x) const { return fixed(x - origin_.x); }
  std::int32_t fixedY(double y) const { return fixed(y - origin_.y); }

  /// The number (that of the first vertex) of edge i of a face, as seen from that face, if it is a
  /// wall; else kNone.
  std::uint32_t wallNumber(std::size_t face, std::size_t i) const {
    return wall_numbers_[3 * face + i];
  }
  /// The same for an open edge that leads out of free space.
  std::uint32_t openNumber(std::size_t face, std::size_t i) const {
    return open_numbers_[3 * face + i];
  }
  /// Whether vertex `number` is joined to the next one.
  bool isEdge(std::uint32_t number) const { return is_edge_[number] != 0; }

  /// The chains of walls and of open edges.
  const std::vector<Run>& walls() const { return walls_; }
  const std::vector<Run>& open() const { return open_; }

  /// Of all that numbers refer to: the order of the vertices follows from that of the faces, which
  /// another version of the triangulation may lay out otherwise.
  std::uint64_t hash() const;
  std::size_t bytes() const;

 private:
  std::int32_t fixed(double coordinate) const;
  void layOut(const Triangulation& t, Passage kind, std::vector<std::uint32_t>& numbers,
              std::vector<Run>& runs);
  void append(const TPoint2D& vertex, bool is_edge);

  TPoint2D origin_;
  double unit_;
  std::vector<std::int32_t> x_, y_;
  std::vector<char> is_edge_;
  std::vector<std::uint32_t> wall_numbers_, open_numbers_;  ///< by 3 * face + edge
  std::vector<Run> walls_, open_;
};

}  // namespace mrpt_polyloc
