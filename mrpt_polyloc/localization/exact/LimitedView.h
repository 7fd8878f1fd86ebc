#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// What is seen around the origin up to a range: vertices counterclockwise [m]; where `is_arc`, the
/// edge from vertex i to vertex i + 1 is the arc of the circle of the range, counterclockwise. No
/// vertices: nothing is within the range.
struct LimitedView {
  std::vector<TPoint2D> vertices;
  std::vector<bool> is_arc;
  double range = 0.0;  ///< [m]
};

/// The part of a visibility polygon around the origin that lies within a range. O(n).
POLYLOC_EXPORT LimitedView withinRange(const std::vector<TPoint2D>& polygon, double range);

/// A LimitedView with its windows told from its walls, as ObservedPolygon does: in pieces, walls
/// and arcs, counterclockwise.
class POLYLOC_EXPORT LimitedPolygon {
 public:
  using Piece = ObservedPolygon::Wall;

  /// \throws InvalidParamsError with coordinates if a vertex is not finite or out of range, if the
  /// end of an arc is not at the range, or if it does not run once, counterclockwise, around the
  /// origin. O(n)
  LimitedPolygon(const LimitedView& view, double tolerance);

  /// Empty if nothing is within the range.
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::vector<Piece> walls() const;
  double range() const { return range_; }

  /// Whether the end of a wall is a vertex of the map: a corner or the near end of a window, and
  /// not where the wall leaves the range.
  bool beginsAtVertex(std::size_t piece) const;
  bool endsAtVertex(std::size_t piece) const;

 private:
  void add(const TPoint2D& a, const TPoint2D& b, bool is_arc);
  bool continues(const Piece& piece, const Piece& next) const;

  std::vector<Piece> pieces_;
  double range_, tolerance_;
};

}  // namespace mrpt_polyloc
