#pragma once

#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <string>

namespace mrpt_polyloc {

/// An occupancy grid as ROS's map_server stores it: a yaml file that names an image (PGM P2 or P5,
/// or PNG; its path is relative to the yaml's folder) and says where it lies and what it means.
///
/// Required keys: `image`, `resolution` [m], `origin` [x m, y m, yaw rad] of the lower left corner,
/// kept exactly, not rounded to cells. Optional: `negate` (0, 1, true or false; 0), `mode`
/// (trinary), `occupied_thresh` (0.65), `free_thresh` (0.25, nav2's default). Of a key that is
/// written twice the last one counts. Other keys are ignored.
///
/// A pixel v of a greatest value m, the mean of its colours, is occupied with probability
/// p = (m - v) / m, or v / m if `negate` is set: above `occupied_thresh` the cell is occupied,
/// below `free_thresh` free, else unknown. Modes `trinary` and `scale` differ only in what
/// map_server publishes between the thresholds, and in transparent pixels: trinary takes those
/// without any opacity for unknown, scale all that are not opaque. Mode `raw`: the pixel, scaled to
/// 255 (255 minus it if `negate` is set), is the percentage of occupancy; above 100 it is unknown.
/// \throws FormatError naming the yaml file and the key, or the image and what is wrong with it.
OccupancyBitmap loadRosMap(const std::string& yaml_path);

}  // namespace mrpt_polyloc
