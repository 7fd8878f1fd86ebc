#pragma once

#include <mrpt_polyloc/geometry/planar_regions.h>
#include <mrpt_polyloc/geometry/ring_cleaning.h>

#include <vector>

namespace mrpt_polyloc {

/// How the rings of polygons with holes wind around every region of the plane, and what that makes
/// of the polygons.
struct FreeSpaceLabels {
  static constexpr int kNotFree = -1;

  /// What a hole is good for.
  enum class HoleUse { needed, outside, covered };

  /// A region that something is wrong with: all refer to polygons.
  struct Trouble {
    int region = 0;
    int polygon = 0;
    int other_polygon = kNotFree;  ///< for overlapping polygons
  };

  std::vector<HoleUse> hole_use;       ///< by ring; outer rings are needed
  std::vector<int> free_of;            ///< by region: the polygon it is free space of, or kNotFree
  std::vector<double> free_area;       ///< by polygon [m2]
  std::vector<double> ambiguous_area;  ///< by polygon [m2], of the regions in the next two
  /// Regions that a ring of the polygon winds around in another way than once.
  std::vector<Trouble> crossed;
  /// Regions that a needed hole takes from outside its polygon.
  std::vector<Trouble> hole_outside;
  /// Regions of two needed holes of one polygon.
  std::vector<Trouble> overlapping_holes;
  /// Regions of free space of several polygons, of which two are named.
  std::vector<Trouble> overlapping_polygons;
};

/// Labels all regions. A region is free space of a polygon if its outer ring winds around it
/// counterclockwise and no hole that is needed does. O(regions + borders), times the depth of
/// nesting.
FreeSpaceLabels labelFreeSpace(const PlanarRegions& regions, const std::vector<CleanRing>& rings,
                               std::size_t polygon_count);

}  // namespace mrpt_polyloc
