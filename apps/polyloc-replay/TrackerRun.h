#pragma once

#include "FilterRun.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc::replay {

/// Runs HypothesisTracker over the log instead of a particle filter; the rest is as runFilter()
/// says. The estimate is the heaviest hypothesis (the origin while there is none), `particles` is
/// the number of hypotheses; nothing is left to chance, the seed is only recorded.
/// \param reported steps at which the poses of all hypotheses are kept
RunRecord runTracker(const ReplaySetup& setup, const std::vector<std::size_t>& replayed,
                     std::uint32_t seed, const std::vector<std::size_t>& reported);

}  // namespace mrpt_polyloc::replay
