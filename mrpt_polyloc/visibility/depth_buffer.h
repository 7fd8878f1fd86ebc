#pragma once

#include <mrpt_polyloc/visibility/BeamPattern.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// A viewpoint relative to the index's origin, and the heading of the beam frame.
struct ViewFrame {
  float x, y;
  float heading;       ///< in [-pi, pi]
  float cosine, sine;  ///< of the heading
};

/// Edges as a frame sees them: front-facing ones only, endpoints' bearings and the coefficients of
/// the inverse range 1 / r = along * cos(bearing) + across * sin(bearing).
struct SeenEdges {
  std::vector<float> right, left;  ///< bearings of the ends, in the beam frame, not wrapped [rad]
  std::vector<float> along, across;
  std::size_t count = 0;
};

/// Projects the edges `numbers[0 .. count)` into the frame.
void projectEdges(const std::vector<VisibleEdgeIndex::Edge>& edges, const std::uint32_t* numbers,
                  std::size_t count, const ViewFrame& frame, SeenEdges& out);

/// Raises `inverse[i]`, i over the sorted beams, to the greatest inverse range of the edges that
/// beam i meets; to be set to 0 before.
void fillDepths(const SeenEdges& edges, const BeamPattern& beams, float* inverse);

/// As fillDepths(), and notes in `nearest[i]` which of the edges it was; unchanged where none.
void fillDepths(const SeenEdges& edges, const BeamPattern& beams, float* inverse,
                std::int32_t* nearest);

}  // namespace mrpt_polyloc
