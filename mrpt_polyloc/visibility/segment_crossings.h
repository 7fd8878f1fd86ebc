#pragma once

#include <mrpt_polyloc/visibility/critical_segments.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// How many pairs of critical segments, and of these and edges between vertices, cross in inner
/// points of both, in floating point (a touch or overlap may count or not). O(S^2) at worst for S
/// of both. Ends early once there are `enough`.
std::size_t countCrossings(const std::vector<CriticalSegment>& segments,
                           const std::vector<std::pair<std::int32_t, std::int32_t>>& edges,
                           const std::vector<TPoint2D>& vertices,
                           std::size_t enough = std::numeric_limits<std::size_t>::max());

}  // namespace mrpt_polyloc
