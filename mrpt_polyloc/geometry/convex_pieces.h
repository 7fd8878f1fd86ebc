#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Free space cut into convex polygons along the lines of a square grid: a square that lies in free
/// space is one piece, one that a border crosses is cut into few pieces. No border runs through a
/// piece, so that what is seen from it can be bounded.
struct ConvexPieces {
  struct Piece {
    std::int32_t column, row;  ///< of the grid's square that holds the piece
    std::uint32_t first;       ///< into `vertices`
    std::uint32_t count;
  };
  std::vector<Piece> pieces;       ///< row by row, in a row by column
  std::vector<TPoint2D> vertices;  ///< counterclockwise, piece by piece [m]
};

/// \param corner of the square (0, 0), at or below the triangulated box's [m]
/// \param size of the squares' sides [m], > 0 \param threads 0: all cores; one result for any
/// Pieces of less than 1e-9 m2 are left out. The triangles that meet a square are clipped to it,
/// and neighbours joined while their union stays convex: O(faces + squares met).
ConvexPieces convexPieces(const Triangulation& triangulation, const TPoint2D& corner, double size,
                          int threads = 0);

}  // namespace mrpt_polyloc
