#pragma once

#include <mrpt_polyloc/visibility/critical_segments.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// How many pairs of critical segments cross in inner points of both, in floating point (a
/// touch or overlap may count or not). O(S^2) at worst.
std::size_t countCrossings(const std::vector<CriticalSegment>& segments,
                           const std::vector<TPoint2D>& vertices);

}  // namespace mrpt_polyloc
