#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <vector>

namespace mrpt_polyloc {

/// Squared distance of each cell's middle to the nearest one of a state [cells2], by cell of the
/// bitmap; infinity where no cell is in that state. O(cells), by the squared distance transform of
/// Felzenszwalb and Huttenlocher (2012), rows after columns.
std::vector<float> squaredDistances(const OccupancyBitmap& bitmap, CellState state);

}  // namespace mrpt_polyloc
