#pragma once

#include <mrpt_polyloc/geometry/tracing.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// Any map file the project reads, by extension: .geojson, .wkt, .json (HouseExpo), .yaml/.yml (ROS
/// map_server), .gridmap[.gz], .simplemap[.gz] (both MRPT's). Grids are traced with `tracing`.
/// \throws FormatError naming file and place; InvalidMapError naming the file, with located
/// defects.
RepairedMap loadMap(const std::string& path, const TracingParams& tracing = {});

}  // namespace mrpt_polyloc
