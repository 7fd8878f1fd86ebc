#pragma once

#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/geometry/OccupancyBitmap.h>

#include <string>

namespace mrpt_polyloc {

/// An occupancy grid as ROS's map_server stores it: a yaml file that names an image (see
/// loadImage()) and says where it lies and what it means. The image's path is relative to the
/// yaml's folder, or begins with `~/`; an absolute one that is not there is looked for beside the
/// yaml.
///
/// Required keys: `image`, `resolution` [m], `origin` [x m, y m, yaw rad] of the lower left corner,
/// kept exactly, not rounded to cells; a yaw that is nan is 0. Optional: `negate` (0, 1, true or
/// false; 0), `mode` (trinary), `occupied_thresh` (0.65), `free_thresh` (0.25, nav2's default). Of
/// a key that is written twice the last one counts. Other keys are ignored.
///
/// A pixel v of a greatest value m, the mean of its colours, is occupied with probability
/// p = (m - v) / m, or v / m if `negate` is set: above `occupied_thresh` the cell is occupied,
/// below `free_thresh` free, else unknown; occupied is asked first, for thresholds may be crossed.
/// But in a trinary image of a map_saver, that is one of the levels 0, 205 and 254 or 255 only, 205
/// is unknown though `free_thresh` would make it free: ROS 2's map_saver writes 0.25 beside it.
/// Modes `trinary` and `scale` differ only in what
/// map_server publishes between the thresholds, and in transparent pixels: trinary takes those
/// without any opacity for unknown, scale all that are not opaque. Mode `raw`: the pixel, scaled to
/// 255 (255 minus it if `negate` is set), is the percentage of occupancy; above 100 it is unknown.
/// \param notes gets a sentence for all that was assumed, and if nearly nothing is unknown; may be
/// null
/// \throws FormatError naming the yaml file and the key, or the image and what is wrong with it.
OccupancyBitmap loadRosMap(const std::string& yaml_path, Notes* notes = nullptr);

/// Which shares of such a map are free, occupied and unknown by which thresholds, which levels its
/// image has, and which thresholds may do better: for the complaint that it has no free space.
/// \throws FormatError as loadRosMap()
std::string rosMapShares(const std::string& yaml_path);

}  // namespace mrpt_polyloc
