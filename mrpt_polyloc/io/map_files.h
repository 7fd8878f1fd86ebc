#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/geometry/bitmap_cleaning.h>
#include <mrpt_polyloc/geometry/tracing.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// How grid maps become polygon maps.
struct POLYLOC_EXPORT GridMapParams {
  GridMapParams() { tracing.max_filled_unknown_area = 0.5; }

  BitmapCleaningParams cleaning;
  /// As its defaults, but specks of unknown cells within free space up to 0.5 m2 count as free:
  /// single cells that no ray passed, thousands of them in maps made from scans.
  TracingParams tracing;
};

/// Any map file the project reads, by extension: .geojson, .wkt, .json (HouseExpo), .yaml/.yml (ROS
/// map_server), .gridmap[.gz], .simplemap[.gz] (both MRPT's). Grids are cleaned and traced.
/// \param notes gets a sentence for all that was assumed of the file; may be null
/// \param scale metres per unit of the file
/// \throws FormatError naming file and place, also if the map cannot be in metres (see
/// requireMetres()); InvalidMapError naming the file, with located
/// defects.
POLYLOC_EXPORT RepairedMap loadMap(const std::string& path, const GridMapParams& params = {},
                                   Notes* notes = nullptr, double scale = 1.0);

}  // namespace mrpt_polyloc
