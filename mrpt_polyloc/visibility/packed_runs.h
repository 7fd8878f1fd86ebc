#pragma once

#include <mrpt_polyloc/visibility/BoundaryChains.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Lists of runs as bytes: of each run how far it begins behind the end of the one before (behind
/// 0, the first), and its edges, both in groups of seven bits, the lowest first, of which all but
/// the last have the eighth bit set. Two bytes a run mostly, where a Run takes eight.

/// Appends runs, which must be in ascending order and not overlap.
void packRuns(const std::vector<BoundaryChains::Run>& runs, std::vector<std::uint8_t>& bytes);

/// Appends the runs of what packRuns() wrote.
void unpackRuns(const std::uint8_t* begin, const std::uint8_t* end,
                std::vector<BoundaryChains::Run>& runs);

/// Whether bytes are such a list, of edges of a layout of so many vertices.
bool arePackedRuns(const std::uint8_t* begin, const std::uint8_t* end, std::size_t vertices);

}  // namespace mrpt_polyloc
