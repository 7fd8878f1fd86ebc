#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// Reads a polygon map file by its extension, in any case: .geojson (the project's own), .wkt, or
/// .json (HouseExpo, or a GeoJSON FeatureCollection after all).
/// \throws FormatError naming the file, and the place in it: missing, empty, a directory, of an
/// unknown extension, or not what its extension says.
POLYLOC_EXPORT RawMap readRawMap(const std::string& path, Notes* notes = nullptr);

/// Reads a polygon map file, checks and repairs it.
/// \param notes gets a sentence for all that was assumed of the file; may be null
/// \param scale metres per unit of the file
/// \throws FormatError as readRawMap(), and if the map cannot be in metres (see requireMetres()).
/// \throws InvalidMapError naming the file and the defects that could not be repaired.
POLYLOC_EXPORT RepairedMap loadPolygonMap(const std::string& path, Notes* notes = nullptr,
                                          double scale = 1.0);

/// The text of a map file with an extension, ".geojson" or ".wkt" in any case.
/// \throws FormatError for another extension.
/// \throws InvalidMapError if such a file cannot hold the map (see toWkt()).
POLYLOC_EXPORT std::string toText(const PolygonMap& map, const std::string& extension);

}  // namespace mrpt_polyloc
