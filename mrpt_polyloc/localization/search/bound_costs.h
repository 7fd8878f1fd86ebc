#pragma once

#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <cstddef>
#include <cstdint>

namespace mrpt_polyloc {

/// Lower bounds of the search cost [units] over all poses of a node at one window of headings after
/// another: positions of its leaves, headings from bin `headings[i]` (less than kBandBins) on, as
/// many as its level's window.
void boundCosts(const SearchTree::Bands& bands, const BandQuery& query,
                const std::uint32_t* headings, std::size_t count, unsigned* bounds);

}  // namespace mrpt_polyloc
