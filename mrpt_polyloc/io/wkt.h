#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>

namespace mrpt_polyloc {

/// Reads POLYGON and MULTIPOLYGON texts, and GEOMETRYCOLLECTIONs of them, in any case, in metres:
/// all of them together are one map whose edges are all walls. A geometry may run over several
/// lines; each starts on its own. EMPTY ones count for nothing. As others write it: Z and M
/// coordinates are dropped, an EWKT's SRID is passed over unless it is of degrees, a semicolon may
/// follow. \param text what the file holds \param file its name, for messages \throws FormatError
/// naming the file, line and column: other geometries, an SRID of degrees, numbers that are not
/// finite, anything out of place, a text of nothing.
POLYLOC_EXPORT RawMap parseWkt(const std::string& text, const std::string& file);

/// The map as one line: a POLYGON, or a MULTIPOLYGON if it has several components. Reads back as
/// exactly the same map.
/// \throws InvalidMapError if the map has open edges or walls beyond, which WKT cannot say.
POLYLOC_EXPORT std::string toWkt(const PolygonMap& map);

}  // namespace mrpt_polyloc
