#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Where views of the cells are taken: the representative of each, and in cells wider than
/// `spacing` the points of a lattice too, but for those nearer to the representative than half of
/// it. Cells in order; those of less than 1e-8 m2 are left out.
POLYLOC_EXPORT std::vector<TPoint2D> cellViewpoints(const VisibilityCells& cells, double spacing);

/// What the map shows all around from each viewpoint, in k samples cut off at `range` [m]: the
/// distance to the first wall, beyond open edges too; where there is none, to the open edge at
/// which knowledge ends. Single precision, see RangePredictor. \param threads 0: all cores
POLYLOC_EXPORT std::vector<SampledPolarFunction> viewsFrom(const std::vector<TPoint2D>& viewpoints,
                                                           const RangePredictor& predictor,
                                                           std::size_t k, double range,
                                                           int threads);

}  // namespace mrpt_polyloc
