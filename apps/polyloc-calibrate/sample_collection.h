#pragma once

#include "../common/search.h"
#include "calibration_sets.h"
#include <mrpt_polyloc/evaluation/calibration_samples.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc::apps {

/// How many scans are localized where.
struct CollectionSize {
  std::size_t own = 1'000'000;  ///< of each set in its own map, at most
  std::size_t cluttered = 60;   ///< good ones of each set, with clutter added, at most
  std::size_t foreign = 40;     ///< of each set in each other map, at most
};

/// Localizes scans of all sets in all maps without any calibration. Of more scans than wanted every
/// so-many-th is taken. Scans with too few beams, and those for which nothing was found, give no
/// sample.
/// \param search its method, max_hypotheses and threads are used
std::vector<CalibrationSample> collectSamples(const Program& program,
                                              const std::vector<CalibrationSet>& sets,
                                              const CollectionSize& size, SearchOptions search);

}  // namespace mrpt_polyloc::apps
