#pragma once

#include <mrpt_polyloc/visibility/critical_segments.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

/// How many pairs of critical segments cross in inner points of both, in floating point (a
/// touch or overlap may count or not). O(S^2) at worst. Ends early once there are `enough`.
std::size_t countCrossings(const std::vector<CriticalSegment>& segments,
                           const std::vector<TPoint2D>& vertices,
                           std::size_t enough = std::numeric_limits<std::size_t>::max());

}  // namespace mrpt_polyloc
