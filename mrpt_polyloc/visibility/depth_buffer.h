#pragma once

#include <mrpt_polyloc/visibility/BeamPattern.h>
#include <mrpt_polyloc/visibility/BoundaryChains.h>
#include <mrpt_polyloc/visibility/FloatBlocks.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A viewpoint in the chains' fixed-point coordinates, and the heading of the beam frame.
struct ViewFrame {
  std::int32_t x, y;
  float unit;          ///< of x and y [m]
  float heading;       ///< in [-pi, pi]
  float cosine, sine;  ///< of the heading
};

/// Memory of raiseDepths(), kept between calls: vertices as a frame sees them, one after another...
struct DepthWorkspace {
  std::vector<float> x, y;            ///< relative to the viewpoint
  std::vector<std::int32_t> is_edge;  ///< whether the vertex is joined to the next one
  std::vector<float> bearing;         ///< in the beam frame, in [-pi, pi] up to rounding
  std::vector<std::int32_t> beam;     ///< first sorted beam at or after the bearing
  /// ... and the edges that face the viewer and cover beams, from a to b. In the end (ax, ay) is
  /// the slope of the inverse range, ax * cos(bearing) + ay * sin(bearing), at most `nearest`.
  struct Edges {
    std::vector<std::int32_t> vertex, from, to;  ///< beams [from, to), across pi if to < from
    std::vector<float> ax, ay, bx, by, nearest;
  } edges;
};

/// Raises `inverse[i]`, i over the sorted beams, to the greatest inverse range [1/m] of the edges
/// of `runs` that beam i meets from their left; to be set to 0 before.
void raiseDepths(const BoundaryChains& chains, const BoundaryChains::Run* runs, std::size_t count,
                 const ViewFrame& frame, const BeamPattern& beams, DepthWorkspace& workspace,
                 FloatBlocks& inverse);

/// Per sorted beam the inverse range of what it hits, and the coefficients of its line (see
/// DepthWorkspace::Edges).
struct HitColumns {
  FloatBlocks inverse, along, across;
};

/// As above, and keeps the line of the edge that each beam hits.
void raiseDepths(const BoundaryChains& chains, const BoundaryChains::Run* runs, std::size_t count,
                 const ViewFrame& frame, const BeamPattern& beams, DepthWorkspace& workspace,
                 HitColumns& hits);

}  // namespace mrpt_polyloc
