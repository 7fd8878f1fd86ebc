#pragma once

#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// How far a vertex of an open line may be from the ring vertex it stands for [m].
constexpr double kOpenLineSnap = 1e-6;

/// Reads the project's own map file: a GeoJSON FeatureCollection in local metres. The property
/// `kind` of a feature says what it is: `free` (Polygon or MultiPolygon: free space), `open`
/// (LineString or MultiLineString: those edges of free space that are open, each vertex a ring
/// vertex, snapped within kOpenLineSnap) or `wall` (LineString or MultiLineString: walls beyond).
/// Features in any order; other properties are ignored. The collection's member `cell_size`, if
/// there is one, is the side of the cells that the map was traced from [m], see PolygonMap.
///
/// As others write it: a feature, a geometry or a GeometryCollection by itself is a map, too; a
/// feature without geometry says nothing; of features without `kind` polygons are free space, and
/// all else is passed over; a third coordinate is dropped.
/// \param notes gets a sentence for features without `kind`; may be null
/// \param doors gets lines without `kind` of which a property says that they are doors (see
/// doorPassages()); null: they are passed over
/// \param text what the file holds
/// \param file its name, for messages
/// \throws FormatError naming the file and the line, or the path of what is wrong, such as
/// `features[2].geometry.coordinates[0][3]`.
RawMap parseGeoJson(const std::string& text, const std::string& file, Notes* notes = nullptr,
                    std::vector<Polyline>* doors = nullptr);

/// The map as such a file: free space as a MultiPolygon; if there are any, open edges as a
/// MultiLineString of runs as long as can be, and walls beyond as a MultiLineString. Reads back as
/// exactly the same map.
std::string toGeoJson(const PolygonMap& map);

}  // namespace mrpt_polyloc
