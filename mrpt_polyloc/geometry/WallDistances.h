#pragma once

#include <mrpt_polyloc/base/TiledGrid.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstddef>

namespace mrpt_polyloc {

/// How far points lie from the nearest wall of any kind, walls beyond included, up to a reach: a
/// grid of distances near walls, interpolated. NearestWalls is exact, and searches a tree.
///
/// Immutable and thread-safe. Within 0.071 m of the truth (half a cell's diagonal), mostly much
/// nearer. Memory and time of building follow the walls' length.
class POLYLOC_EXPORT WallDistances {
 public:
  static constexpr double kReach = 0.8;     ///< [m]: beyond, all is far
  static constexpr double kCellSize = 0.1;  ///< [m]; more on maps of more than 400 km2

  explicit WallDistances(const Triangulation& triangulation);

  /// The distance to the nearest wall [m], at most kReach; kReach outside the triangulated box.
  double at(double x, double y) const;

  std::size_t bytes() const { return grid_.bytes(); }

 private:
  void take(const TPoint2D& a, const TPoint2D& b);
  void takePiece(const TPoint2D& a, const TPoint2D& b);
  double atCorner(int column, int row) const;

  TPoint2D origin_;
  double cell_size_;
  TiledGrid grid_;  ///< of the cells' corners, in units of kUnit
};

}  // namespace mrpt_polyloc
