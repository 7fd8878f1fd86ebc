#pragma once

#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <cstddef>
#include <cstdint>

namespace mrpt_polyloc {

/// What the search says of one pose [m]: means over the beams.
struct ViewCost {
  float search;  ///< the search cost
  /// The same with no beam counting for more than kMostClipped: low where many beams are explained,
  /// however wrong the others are. (With the polar metric it is the search cost.)
  float clipped;
};

/// What map and world differ by in a beam is mostly far more than this, and where a pose is off by
/// half a leaf beams differ by less [m].
constexpr double kMostClipped = 0.3;

/// Of the pose in the middle of a leaf whose heading is where bin `heading` begins; a beam that is
/// not in phase may meet what the bin's end meets as well.
ViewCost viewCost(const SearchTree::View& view, const BandQuery& query, std::size_t heading);

}  // namespace mrpt_polyloc
