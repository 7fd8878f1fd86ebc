#pragma once

#include <mrpt_polyloc/visibility/critical_segments.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// The bounded faces left of the boundary in an arrangement of segments, as flat arrays.
struct ArrangedFaces {
  struct Edge {
    std::int32_t from;  ///< the edge's first vertex; its last is that of the next edge
    std::int32_t
        neighbor;  ///< the face on the other side; Triangulation::kNone across the boundary
    std::uint32_t first_window;  ///< into `windows`; to the next edge's first_window
  };
  std::vector<TPoint2D> vertices;     ///< rounded to double
  std::vector<std::uint32_t> first;   ///< of each face its first edge; and the end
  std::vector<Edge> edges;            ///< counterclockwise, face by face; and one more to end
  std::vector<std::int32_t> windows;  ///< critical segments along an edge: i + 1 if the edge runs
                                      ///< with the segment, -(i + 1) if against it
};

/// The arrangement of the boundary (directed edges, free space on the left), of edges that only
/// divide, and of the critical segments: all crossings exact, overlaps of any kind allowed.
/// O((N + K) log N) for N segments with K crossings. \throws InvalidMapError if it fails.
ArrangedFaces arrangeSegments(const std::vector<TPoint2D>& vertices,
                              const std::vector<std::pair<std::int32_t, std::int32_t>>& boundary,
                              const std::vector<std::pair<std::int32_t, std::int32_t>>& dividers,
                              const std::vector<CriticalSegment>& segments);

}  // namespace mrpt_polyloc
