#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <string>

namespace mrpt_polyloc {

/// Side of the cells of a grid made from a simplemap [m].
constexpr double kSimpleMapResolution = 0.05;

/// An MRPT occupancy grid (COccupancyGridMap2D, plain or gzipped): cells above 0.65 probability of
/// being occupied are occupied, those below 0.196 free (the thresholds of ROS), the others unknown.
/// \throws FormatError naming file and object: missing, empty, truncated or damaged file, another
/// class, something behind the map, no cell, more than kMaxBitmapCells, no positive resolution.
OccupancyBitmap loadGridMap(const std::string& path);

/// An MRPT simplemap (CSimpleMap: poses and their observations, plain or gzipped), its laser scans
/// inserted into an occupancy grid of kSimpleMapResolution at the mean of their poses, with the
/// insertion options of MRPT's demo of pf-localization; then as loadGridMap().
/// \throws FormatError as loadGridMap(), and if a pose of a robot or a sensor is not finite, they
/// are so far apart, or so far from the origin, that the grid would exceed kMaxBitmapCells, a valid
/// reading is negative or no number, or no observation can be inserted into a grid.
OccupancyBitmap loadSimpleMap(const std::string& path);

}  // namespace mrpt_polyloc
