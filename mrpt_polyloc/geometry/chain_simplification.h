#pragma once

#include <mrpt_polyloc/geometry/border_chains.h>

namespace mrpt_polyloc {

/// Removes corners of chains as long as the removed ones lie within `tolerance` [cells] of the edge
/// that replaces them, cheapest first; ends of chains stay. Topology is kept: chains neither cross
/// nor touch but where they did before, and closed chains keep at least three corners. A closed
/// chain is simplified within half of the shorter side of its box at most, so that specks keep
/// their size.
///
/// Greedy vertex removal as in Dyken, Daehlen, Sevaldrud, "Simultaneous curve simplification"
/// (2009), with one difference: all vertices are corners of cells, so the test whether a triangle
/// is empty looks at bits of a bitmap and needs no triangulation. Integer predicates, hence exact.
/// `width` and `height` are those of the bitmap the chains come from.
BorderChains simplifyChains(const BorderChains& borders, int width, int height, double tolerance);

}  // namespace mrpt_polyloc
