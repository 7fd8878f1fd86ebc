#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// The lattice points (column, row) where a sensor may be: corner of the triangulated box plus
/// (column, row) times spacing, in free space. Found by scan conversion of the triangles: O(faces +
/// points), row by row.
std::vector<std::pair<std::int32_t, std::int32_t>> searchPositions(
    const Triangulation& triangulation, double spacing);

}  // namespace mrpt_polyloc
