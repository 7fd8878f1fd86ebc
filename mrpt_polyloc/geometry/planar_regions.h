#pragma once

#include <mrpt_polyloc/geometry/noding.h>

#include <array>
#include <vector>

namespace mrpt_polyloc {

/// The plane cut into regions by noded rings, each region a set of triangles.
struct PlanarRegions {
  static constexpr int kNone = -1;

  /// Edge i lies opposite node i, from node i + 1 to node i + 2 (mod 3).
  struct Face {
    std::array<int, 3> node;      ///< counterclockwise
    std::array<int, 3> neighbor;  ///< face across edge i, kNone outside the convex hull
    std::array<int, 3> border;    ///< index of the border that edge i is, or kNone
    int region;
  };
  /// All pieces of rings that run between the same two nodes.
  struct Border {
    int low_node;
    int high_node;
    std::vector<EdgePiece> pieces;
  };

  std::vector<TPoint2D> nodes;
  std::vector<Face> faces;
  std::vector<Border> borders;
  std::vector<double> region_area;  ///< [m2]; region 0 is the outside, of area 0

  /// The region across edge i of a face.
  int regionAcross(const Face& face, std::size_t i) const {
    return face.neighbor[i] == kNone ? 0 : faces[static_cast<std::size_t>(face.neighbor[i])].region;
  }
};

/// Cuts the plane along completely noded rings of which at least one has an area.
PlanarRegions cutIntoRegions(const NodedRings& noded);

}  // namespace mrpt_polyloc
