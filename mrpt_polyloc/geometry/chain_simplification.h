#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/border_chains.h>

namespace mrpt_polyloc {

/// Simplifies chains within `tolerance_cells` without changing their topology: ends stay, chains
/// neither cross nor touch but where they did before, closed ones keep at least three points.
///
/// First every step of a staircase (a side of one cell between opposite turns) shrinks to its
/// midpoint: a slanted wall runs through the midpoints, so this takes neither its inner nor its
/// outer corners and leaves no bias. Then points are removed, cheapest first, as long as all points
/// of the exact border lie within the tolerance of the edge that replaces them and the triangle
/// that is cut off holds no other vertex (greedy vertex removal as in Dyken, Daehlen, Sevaldrud,
/// "Simultaneous curve simplification", 2009). All vertices are lattice points, so the test looks
/// at a bitmap and is exact in integers; CGAL's Polyline_simplification_2, which looks at a
/// triangulation, takes some 70 times as long (tests/bench/simplification_bench.cpp). Closed chains
/// are simplified within half of the shorter side of their box at most: specks keep their size.
///
/// `width` and `height` are those of the bitmap the chains come from.
POLYLOC_EXPORT BorderChains simplifyChains(const BorderChains& borders, int width, int height,
                                           double tolerance_cells);

}  // namespace mrpt_polyloc
