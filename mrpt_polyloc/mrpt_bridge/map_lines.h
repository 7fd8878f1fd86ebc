#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/io/mrpt_compat.h>

namespace mrpt_polyloc {

/// Adds a map to a scene of MRPT's as lines in the plane z = 0 [m], one CSetOfLines each: walls
/// dark blue (20, 30, 90), open edges orange (255, 140, 0), walls beyond grey (130, 130, 130). All
/// three are added, empty or not.
POLYLOC_EXPORT void addMapLines(const PolygonMap& map, drawn::CSetOfObjects& out);

}  // namespace mrpt_polyloc
