#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// One thing wrong with a map, and where [m].
struct POLYLOC_EXPORT Defect {
  std::string what;  ///< e.g. "self-crossing ring", "hole outside its polygon", "repeated vertex"
  TPoint2D where{0, 0};
};

/// One thing done about a defect, and where.
struct POLYLOC_EXPORT Repair {
  std::string what;
  TPoint2D where{0, 0};
};

/// Rings as a file holds them, before anything is known of them: any orientation, the first vertex
/// perhaps repeated at the end, not necessarily simple.
struct POLYLOC_EXPORT RawPolygon {
  Ring outer;
  std::vector<Ring> holes;
};
struct POLYLOC_EXPORT RawMap {
  std::vector<RawPolygon> polygons;
  std::vector<Polyline> walls_beyond;
};

/// A valid map and what had to be done to get it.
struct POLYLOC_EXPORT RepairedMap {
  PolygonMap map;
  std::vector<Defect> defects;  ///< all that was found, repaired ones too
  std::vector<Repair> repairs;
};

/// What there is to say of a raw map, usable or not.
struct POLYLOC_EXPORT MapInspection {
  std::optional<PolygonMap> map;   ///< the valid map, if every defect could be repaired
  std::vector<Defect> defects;     ///< all that was found, repaired ones too
  std::vector<Defect> unrepaired;  ///< those in the way; empty exactly if there is a map
  std::vector<Repair> repairs;
};

/// Coordinates beyond this [m] are refused: no map on Earth has them, and up to here the spacing of
/// doubles is below a micrometre.
constexpr double kMaxCoordinate = 1e9;

/// A polygon whose rings cross is repaired only where it hardly matters how they are read: where
/// the area that some ring winds around in another way than once, or that a hole takes from outside
/// its polygon, is at most this [m2] ...
constexpr double kMaxAmbiguousArea = 0.01;
/// ... and at most this fraction of the polygon's free area.
constexpr double kMaxAmbiguousFraction = 1e-4;

/// More crossings and overlaps of edges than this are not listed: the map is refused.
constexpr std::size_t kMaxContacts = 10000;

/// Finds the defects of a raw map and repairs those whose repair is unambiguous.
///
/// Conventions, not defects: orientation, a repeated closing vertex, collinear vertices. Legal, and
/// kept: rings that touch themselves or one another at points.
///
/// Repaired: repeated vertices and spikes (walls of zero width) are removed; holes of zero area,
/// outside their polygon or inside another hole are dropped; overlapping holes are united; edges
/// that a polygon's rings share are removed or made one border; self-crossings, and holes that
/// cross the outer ring, are repaired within kMaxAmbiguousArea and kMaxAmbiguousFraction (free is
/// what the outer ring winds around counterclockwise and no hole does). Every edge keeps its kind;
/// where a wall and an open edge coincide, the wall stands. Walls beyond are only rid of repeated
/// points.
///
/// Everything else is refused: coordinates that are not finite or beyond kMaxCoordinate, outer
/// rings of zero area, larger crossings, components that overlap or share an edge.
///
/// Exact: orientations are decided without rounding; crossing points are rounded to doubles and the
/// result is free of crossings as it stands. O(n log n) in vertices for maps as they are found; the
/// worst case (n edges with mutually overlapping bounding boxes) is quadratic.
POLYLOC_EXPORT MapInspection inspectMap(const RawMap& raw);

/// inspectMap() for those who want the map.
/// \throws InvalidMapError listing the defects (what and where) that could not be repaired.
POLYLOC_EXPORT RepairedMap repairMap(const RawMap& raw);

/// "what at (x, y)" with millimetres.
POLYLOC_EXPORT std::string toString(const Defect& defect);

}  // namespace mrpt_polyloc
