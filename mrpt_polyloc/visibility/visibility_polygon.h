#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>

#include <vector>

namespace mrpt_polyloc {

/// The visibility polygon of a view: its boundary counterclockwise, star-shaped around the
/// viewpoint; windows are the edges between pieces that do not meet. Regularised: antennae seen
/// along a line have no area and are left out. Vertices that repeat are given once.
/// Empty for an empty view.
POLYLOC_EXPORT std::vector<TPoint2D> visibilityPolygon(const Triangulation& triangulation,
                                                       const View& view);

}  // namespace mrpt_polyloc
