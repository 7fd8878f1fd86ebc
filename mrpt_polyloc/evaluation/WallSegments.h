#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <vector>

namespace mrpt_polyloc {

/// A straight wall [m].
struct POLYLOC_EXPORT WallSegment {
  TPoint2D a, b;
};

/// Range [m] from a point along a unit vector to a wall, its end points included; infinity if it is
/// not met.
POLYLOC_EXPORT double rangeTo(const WallSegment& wall, const TPoint2D& origin, const TPoint2D& ray);

/// How a room differs from its map.
struct POLYLOC_EXPORT RoomChanges {
  struct Disc {
    TPoint2D center;  ///< [m]
    double radius;    ///< [m]
  };
  struct MovedWall {
    TPoint2D at;  ///< the edge of a wall nearest to this point is moved [m]
    TPoint2D by;  ///< so far [m]; its neighbours stay, and gaps open between them
  };
  std::vector<Disc> discs;  ///< round things that stand in it
  std::vector<MovedWall> moved;

  /// \throws InvalidParamsError naming the bad field: not finite, or a radius not positive
  void check() const;
};

/// All walls of a map as a bare list of segments, searched one by one in double.
///
/// Slow and simple on purpose: simulated scans and tests need ranges that share nothing with the
/// search's own predictor. Open edges are left out (a beam passes them), walls beyond are in.
class POLYLOC_EXPORT WallSegments {
 public:
  explicit WallSegments(const PolygonMap& map);
  /// The walls of the room as it is now. \throws InvalidParamsError
  WallSegments(const PolygonMap& map, const RoomChanges& changes);

  /// Range [m] from a point along a direction (angle in the map [rad]) to the first wall or disc;
  /// infinity if there is none. A wall's end points belong to it; within a disc the range is 0.
  /// O(number of walls).
  double range(const TPoint2D& origin, double direction) const;

  /// Distance [m] to the nearest wall or disc, 0 within one; infinity if there is none. O(number of
  /// walls).
  double distance(const TPoint2D& point) const;

 private:
  std::vector<WallSegment> segments_;
  std::vector<RoomChanges::Disc> discs_;
};

}  // namespace mrpt_polyloc
