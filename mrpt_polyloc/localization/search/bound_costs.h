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

/// The same at headings of a single bin each, of a node whose windows are of two bins: a leaf. A
/// beam in phase then meets one bin, and both windows that the bin is of bound it. (One that is not
/// meets two, as the beams in phase of boundCosts().) Never less than boundCosts() of a window that
/// holds the bin.
void boundCostsOfBins(const SearchTree::Bands& bands, const BandQuery& query,
                      const std::uint32_t* headings, std::size_t count, unsigned* bounds);

}  // namespace mrpt_polyloc
