#pragma once

#include <mrpt_polyloc/geometry/free_space_labels.h>

#include <vector>

namespace mrpt_polyloc {

/// The free space of the wanted polygons as the labels say, with its border made again: by polygon,
/// one free polygon for each part connected by more than points. Edges are walls where any needed
/// ring of the polygon has a wall there. Parts and holes of no measurable area are left out.
std::vector<std::vector<FreePolygon>> traceFreeSpace(const PlanarRegions& regions,
                                                     const FreeSpaceLabels& labels,
                                                     const std::vector<CleanRing>& rings,
                                                     const std::vector<bool>& is_wanted);

}  // namespace mrpt_polyloc
