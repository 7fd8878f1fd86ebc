#pragma once

#include <mrpt_polyloc/localization/search/RangeBands.h>

#include <array>
#include <cstddef>

namespace mrpt_polyloc {

/// What bounds the cost of a beam that points anywhere into an angular bin from any pose of a node,
/// by its range z [m]:
///  - below `near_low` it falls short of all walls and open edges, by near_low - z at least;
///  - above `wall_high` it has passed a wall, by z - wall_high at least;
///  - between `gap_low` and `gap_high` it is either past a wall, by z - gap_low at least, or short
///    of one, by gap_high - z at least, perhaps beyond an open edge. Where a nearer wall ends
///    within the bin, the ranges are its and those of what is seen past it, and nothing between.
/// gap_low >= gap_high: no such gap.
struct BinBand {
  float near_low, wall_high, gap_low, gap_high;
  bool may_be_open;  ///< an open edge may come before the wall

  bool hasGap() const { return gap_low < gap_high; }
};

/// Of all angular bins, entry b being of the window of bins that begins with b.
using NodeBands = std::array<BinBand, kBandBins>;

/// Of a leaf, over windows of one bin. A wall that may be seen more than the horizon [m] behind an
/// open edge may as well not be known (see PredictedRanges).
void bandsOfLeaf(const RangeBands& ranges, double horizon, NodeBands& bands);

/// Makes `to` hold what `from` holds as well, entry b of the latter being taken for b - shift.
void unite(const NodeBands& from, std::size_t shift, NodeBands& to);

/// Makes windows of `window` bins twice as wide.
void doubleWindow(std::size_t window, NodeBands& bands);

}  // namespace mrpt_polyloc
