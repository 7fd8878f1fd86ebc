#pragma once

#include "posed_scans.h"
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Which rows of a drive make the map, and which are localized in it.
struct DriveParts {
  std::vector<std::size_t> mapping, scans;
};

/// Cuts a drive into stretches of `block` metres of way: the first, third ... make the map.
DriveParts partsOf(const PosedScans& drive, double block);

/// The scan as MRPT's observation, its beams evenly spread as their bearings say.
/// \throws FormatError(file, scan) if they are not even within 0.1 degrees
mrpt::obs::CObservation2DRangeScan observationOf(const RangeScan& scan, double stamp,
                                                 const std::string& file, std::size_t row);

/// An occupancy grid by MRPT: the scans of these rows inserted at their poses into a
/// COccupancyGridMap2D (up to 80 m, certainty 0.6), occupied above 0.65, free below 0.25. \throws
/// FormatError(file) if no cell comes out free
OccupancyBitmap mapOf(const PosedScans& drive, const std::vector<std::size_t>& rows,
                      double resolution, const std::string& file);

/// map.pgm and map.yaml as ROS's map_saver writes them.
std::string toPgm(const OccupancyBitmap& bitmap);
std::string toRosYaml(const OccupancyBitmap& bitmap, const std::string& image);

/// The rows, counted within `rows`, whose scan agrees with the map: the sensor stood in free space,
/// and at most a fifth of the hits end 0.3 m before or behind what the map has.
std::vector<std::size_t> goodRows(const PosedScans& drive, const std::vector<std::size_t>& rows,
                                  const OccupancyBitmap& bitmap);

}  // namespace mrpt_polyloc::apps
