#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// One thing wrong with a map, and where [m].
struct Defect {
  std::string what;  ///< e.g. "self-crossing ring", "hole outside its polygon", "repeated vertex"
  TPoint2D where{0, 0};
};

/// One thing done about a defect, and where.
struct Repair {
  std::string what;
  TPoint2D where{0, 0};
};

/// Rings as a file holds them, before anything is known of them: any orientation, the first vertex
/// perhaps repeated at the end, not necessarily simple.
struct RawPolygon {
  Ring outer;
  std::vector<Ring> holes;
};
struct RawMap {
  std::vector<RawPolygon> polygons;
  std::vector<Polyline> walls_beyond;
};

/// A valid map and what had to be done to get it.
struct RepairedMap {
  PolygonMap map;
  std::vector<Defect> defects;  ///< all that was found, repaired ones too
  std::vector<Repair> repairs;
};

/// Finds the defects of a raw map and repairs those whose repair is unambiguous.
///
/// Orientation and a repeated closing vertex are conventions, not defects.
/// \throws InvalidMapError listing the defects (what and where) that could not be repaired.
RepairedMap repairMap(const RawMap& raw);

/// "what at (x, y)" with millimetres.
std::string toString(const Defect& defect);

}  // namespace mrpt_polyloc
