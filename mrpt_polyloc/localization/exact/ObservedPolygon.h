#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A visibility polygon around the origin, with its windows told from its walls by geometry alone.
///
/// An edge of which the farther end lies within `tolerance` of the ray through the nearer one is a
/// window, or too narrow to matter; all others are walls, seen from their free side.
class POLYLOC_EXPORT ObservedPolygon {
 public:
  /// A wall as it is seen: on the line normal . x = distance, over the directions from `begin` to
  /// the begin of the next wall.
  struct Wall {
    double begin;  ///< [rad], of `from`
    TPoint2D from, to;
    TPoint2D normal;      ///< of length 1, away from the origin
    double distance;      ///< of the line from the origin [m], > 0
    bool is_arc = false;  ///< not a wall: the circle of that distance, where sight ends
  };

  /// Vertices nearer than `tolerance` to the one before, or to the line through their neighbours,
  /// are dropped. \throws InvalidParamsError with coordinates if fewer than three are left, if one
  /// is not finite, or if the polygon does not run once, counterclockwise and without turning back,
  /// around the origin (not star-shaped, or the origin outside or on the border). O(n).
  ObservedPolygon(const std::vector<TPoint2D>& vertices, double tolerance);

  /// In counterclockwise order.
  const std::vector<Wall>& walls() const { return walls_; }
  double radius() const { return radius_; }  ///< greatest distance of a vertex [m]

  /// Whether the end of a wall is a corner or the near end of a window: a vertex of the map.
  bool beginsAtVertex(std::size_t wall) const;
  bool endsAtVertex(std::size_t wall) const;

  /// Whether windows, walls and corners were told apart without doubt: whatever was compared with
  /// the tolerance was at least four times as large, or a hundredth of it at most (rounding).
  bool isClear() const { return is_clear_; }

  /// What is constant while the viewpoint moves within its visibility cell. Where the viewpoint is
  /// in line with two vertices, the skeleton of the side from which less of them is seen.
  VisibilitySkeleton skeleton() const;

 private:
  /// Whether a length is within a limit of some tolerances; notes where that is in doubt.
  bool isWithin(double length, double limit);
  std::vector<TPoint2D> cleaned(const std::vector<TPoint2D>& vertices);
  bool isBetween(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c);

  std::vector<Wall> walls_;
  double tolerance_;
  double radius_ = 0.0;
  bool is_clear_ = true;
};

/// Whether two views agree: in every direction, the point seen in one lies within `limit` of the
/// line seen in the other, but for sectors that are at most a few `limit` wide where the nearer
/// view ends (a window that turns with the observer, a gap that is just closed). O(p + q).
POLYLOC_EXPORT bool agree(const ObservedPolygon& a, const ObservedPolygon& b, double limit);

/// The same of views in pieces, of which one may be of limited range: where it has an arc, the
/// other has one too, or goes on at least as far.
POLYLOC_EXPORT bool agree(const std::vector<ObservedPolygon::Wall>& a,
                          const std::vector<ObservedPolygon::Wall>& b, double limit);

}  // namespace mrpt_polyloc
