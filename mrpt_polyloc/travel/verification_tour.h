#pragma once

#include <mrpt_polyloc/base/export.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// Places and the ways between them: for each place its neighbours and how far they are [m].
/// Undirected: each way is listed at both ends.
using TravelGraph = std::vector<std::vector<std::pair<std::uint32_t, double>>>;

/// Distances [m] of all places from one; infinity where there is no way.
POLYLOC_EXPORT std::vector<double> distancesFrom(const TravelGraph& graph, std::size_t start);

/// The most rivals a tour is found for: its cost grows with two to their power.
constexpr std::size_t kMostTourRivals = 16;

/// The length [m] of a shortest walk from a place that tells the truth from each of its rivals, and
/// leads back: what a robot would drive that knew where it is and only had to prove it (d of Dudek,
/// Romanik and Whitesides). Dijkstra's algorithm over places and sets of rivals told apart by then:
/// O(2^rivals * ways).
/// \param told for each place the rivals that a scan there tells from the truth, as bits
/// \param back whether the way back counts
/// \return none if some rival is told apart nowhere within reach
/// \throws InvalidParamsError for more rivals than kMostTourRivals
POLYLOC_EXPORT std::optional<double> shortestVerificationTour(
    const TravelGraph& graph, std::size_t start, const std::vector<std::uint32_t>& told,
    std::size_t rivals, bool back = true);

}  // namespace mrpt_polyloc
