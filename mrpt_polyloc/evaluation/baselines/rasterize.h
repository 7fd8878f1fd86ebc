#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

namespace mrpt_polyloc {

/// A polygon map drawn into grid cells, for methods that search in grids: a cell whose middle lies
/// in free space is free, and every cell that a wall (or a wall beyond) runs through is occupied;
/// all else is unknown. With a margin of some cells. \param cell side of a cell [m]
/// \throws InvalidParamsError for a side that is not positive, or so small that there would be more
/// than 400 million cells
OccupancyBitmap rasterize(const PolygonMap& map, double cell);

}  // namespace mrpt_polyloc
