#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/border_chains.h>

#include <functional>
#include <vector>

namespace mrpt_polyloc {

/// Places a lattice point in the map [m].
using LatticePlacement = std::function<TPoint2D(const LatticePoint&)>;

/// Joins the chains that border on free space into rings and the rings into one polygon per free
/// component. Where a component touches itself at a corner, the border is cut there into rings that
/// touch, so that every ring is simple.
std::vector<FreePolygon> assemblePolygons(const BorderChains& borders, int component_count,
                                          const LatticePlacement& place);

/// The chains between occupied and unknown cells; closed ones end where they begin.
std::vector<Polyline> collectWallsBeyond(const BorderChains& borders,
                                         const LatticePlacement& place);

}  // namespace mrpt_polyloc
