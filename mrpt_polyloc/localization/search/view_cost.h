#pragma once

#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <cstddef>
#include <cstdint>

namespace mrpt_polyloc {

/// The search cost [m] at the pose in the middle of a leaf whose heading is where bin `heading`
/// begins; a beam that is not in phase may meet what the bin's end meets as well.
float viewCost(const SearchTree::View& view, const BandQuery& query, std::size_t heading);

}  // namespace mrpt_polyloc
