#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/bound_costs.h>
#include <mrpt_polyloc/localization/search/lanes.h>

namespace mrpt_polyloc {
namespace {

using lanes::Bytes, lanes::Words, lanes::Quads;
using lanes::load, lanes::takeMin, lanes::takeMax, lanes::subtractSaturated, lanes::select;

constexpr std::size_t kLanes = BandQuery::kLanes;
static_assert(kLanes == lanes::kBytes && SearchTree::kStride == BandQuery::kVectors * kLanes);
/// The entries of the last vector that still are bins; the rest of an array repeats its begin.
constexpr lanes::FirstLanes<std::uint8_t, kBandBins % kLanes> kLast;

enum class Summation {
  bytes,   ///< of costs whose caps allow that
  words,   ///< of any costs
  squares  ///< of the costs' squares
};

/// Sums side by side.
template <Summation>
struct Sums;
template <>
struct Sums<Summation::bytes> {
  Bytes sums{};
  POLYLOC_LANES void add(const Bytes& costs) { sums += costs; }
};
template <>
struct Sums<Summation::words> {
  Words sums{};
  POLYLOC_LANES void add(const Bytes& costs) {
    Words pairs;
    load(&costs, pairs);
    sums += (pairs & 0xFF) + (pairs >> 8);
  }
};
template <>
struct Sums<Summation::squares> {
  Quads sums{};
  POLYLOC_LANES void add(const Bytes& costs) {
    Words pairs;
    load(&costs, pairs);
    addSquares(pairs & 0xFF);
    addSquares(pairs >> 8);
  }
  POLYLOC_LANES void addSquares(const Words& costs) {
    const Words squares = costs * costs;
    Quads pairs;
    load(&squares, pairs);
    sums += (pairs & 0xFFFF) + (pairs >> 16);
  }
};

/// The bands of some bins.
struct Bins {
  Bytes near_low, wall_high, gap_low, gap_high, may_be_open;
};

/// What bounds the beam that is held against entry b of a node's arrays.
enum class Met {
  entry,   ///< the window that the entry is of: the beam meets bins of it alone
  either,  ///< that one or the next
  common   ///< what is common to both: the bin b + 1 alone, if windows are of two bins
};

/// A gap becomes what it and another exclude together: both where they overlap, else the wider one.
POLYLOC_LANES void joinGaps(const Bytes& other_low, const Bytes& other_high, Bytes& low,
                            Bytes& high) {
  Bytes width = high, other_width = other_high, first_low = low, last_high = high;
  takeMin(first_low, other_low);
  takeMax(last_high, other_high);
  const Bytes overlap = Bytes((low < other_high) & (other_low < high));
  subtractSaturated(width, low);
  subtractSaturated(other_width, other_low);
  const Bytes is_other_wider = Bytes(other_width > width);
  select(is_other_wider, other_low, low);
  select(is_other_wider, other_high, high);
  select(overlap, first_low, low);
  select(overlap, last_high, high);
}

template <Met met>
POLYLOC_LANES void loadBins(const SearchTree::Bands& bands, std::size_t first, Bins& bins) {
  load(bands.near_low + first, bins.near_low);
  load(bands.wall_high + first, bins.wall_high);
  load(bands.gap_low + first, bins.gap_low);
  load(bands.gap_high + first, bins.gap_high);
  bins.may_be_open = Bytes{} - (bins.gap_low & 1);
  if (met == Met::entry) return;
  Bytes near_low, wall_high, gap_low, gap_high;
  load(bands.near_low + first + 1, near_low);
  load(bands.wall_high + first + 1, wall_high);
  load(bands.gap_low + first + 1, gap_low);
  load(bands.gap_high + first + 1, gap_high);
  const Bytes may_be_open = Bytes{} - (gap_low & 1);
  if (met == Met::either) {
    takeMin(bins.near_low, near_low);
    takeMax(bins.wall_high, wall_high);
    takeMax(bins.gap_low, gap_low);
    takeMin(bins.gap_high, gap_high);
    bins.may_be_open |= may_be_open;
  } else {
    takeMax(bins.near_low, near_low);
    takeMin(bins.wall_high, wall_high);
    joinGaps(gap_low, gap_high, bins.gap_low, bins.gap_high);
    bins.may_be_open &= may_be_open;
  }
}

/// The cases of BinBand. Of one band at most one of them costs a beam anything; where bands are
/// joined, all of them hold, and the greatest counts.
template <bool has_open, bool has_no_returns, Met met>
POLYLOC_LANES void costsOf(const Bins& bins, const BandQuery& query, const BandQuery::Scaled& scan,
                           std::size_t rotated, Bytes& costs) {
  Bytes short_range, long_range;
  load(scan.short_range.data() + rotated, short_range);
  load(scan.long_range.data() + rotated, long_range);
  Bytes beyond = long_range, cap_long = Bytes{} + scan.cap_long;
  subtractSaturated(beyond, bins.wall_high);
  if (has_no_returns) {
    Bytes no_return;
    load(query.no_return.data() + rotated, no_return);
    select(no_return, Bytes{} + scan.cap_none, cap_long);
    // Past an open edge, nothing need return.
    if (has_open) cap_long &= ~(no_return & bins.may_be_open);
  }
  takeMin(beyond, cap_long);
  Bytes falls_short = bins.near_low;
  subtractSaturated(falls_short, short_range);
  takeMin(falls_short, Bytes{} + scan.cap_short);
  Bytes in_gap = bins.gap_high, cap_gap = Bytes{} + scan.cap_gap;
  if (has_open) select(bins.may_be_open, Bytes{} + scan.cap_open_gap, cap_gap);
  subtractSaturated(long_range, bins.gap_low);
  subtractSaturated(in_gap, short_range);
  takeMin(in_gap, long_range);
  takeMin(in_gap, cap_gap);
  if (met == Met::common) {
    costs = falls_short;
    takeMax(costs, beyond);
    takeMax(costs, in_gap);
  } else {
    costs = falls_short + beyond + in_gap;
  }
}

template <bool has_open, Met met, bool has_no_returns, Summation summation>
POLYLOC_LANES void boundAll(const SearchTree::Bands& bands, const BandQuery& query,
                            const std::uint32_t* headings, std::size_t count, unsigned* bounds) {
  constexpr std::size_t kShift = met == Met::common ? 1 : 0;
  const BandQuery::Scaled& scan = query.scaled[bands.scale];
  Bins bins[BandQuery::kVectors];
  for (std::size_t v = 0; v < BandQuery::kVectors; ++v) {
    loadBins<met>(bands, v * kLanes, bins[v]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    Sums<summation> sums;
    for (std::size_t v = 0; v < BandQuery::kVectors; ++v) {
      const std::size_t rotated = v * kLanes + kBandBins + kShift - headings[i];
      if (!query.informs_from[rotated]) continue;
      Bytes costs;
      costsOf<has_open, has_no_returns, met>(bins[v], query, scan, rotated, costs);
      if (v + 1 == BandQuery::kVectors) {
        Bytes last;
        load(kLast.mask, last);
        costs &= last;
      }
      sums.add(costs);
    }
    bounds[i] = lanes::sumOf(sums.sums)
                << (summation == Summation::squares ? 2 * bands.scale : bands.scale);
  }
}

template <bool has_open, Met met>
POLYLOC_LANES void chooseByBeams(const SearchTree::Bands& bands, const BandQuery& query,
                                 const std::uint32_t* headings, std::size_t count,
                                 unsigned* bounds) {
  constexpr auto bytes = Summation::bytes, words = Summation::words, squares = Summation::squares;
  if (query.metric == SearchMetric::polar) {
    boundAll<has_open, met, false, squares>(bands, query, headings, count, bounds);
  } else if (query.has_wide_caps) {
    boundAll<has_open, met, true, words>(bands, query, headings, count, bounds);
  } else if (query.has_no_returns) {
    boundAll<has_open, met, true, bytes>(bands, query, headings, count, bounds);
  } else {
    boundAll<has_open, met, false, bytes>(bands, query, headings, count, bounds);
  }
}

template <Met met>
POLYLOC_LANES void chooseByOpen(const SearchTree::Bands& bands, const BandQuery& query,
                                const std::uint32_t* headings, std::size_t count,
                                unsigned* bounds) {
  bands.has_open ? chooseByBeams<true, met>(bands, query, headings, count, bounds)
                 : chooseByBeams<false, met>(bands, query, headings, count, bounds);
}

}  // namespace

POLYLOC_HOT_LOOP
void boundCosts(const SearchTree::Bands& bands, const BandQuery& query,
                const std::uint32_t* headings, std::size_t count, unsigned* bounds) {
  query.is_in_phase ? chooseByOpen<Met::entry>(bands, query, headings, count, bounds)
                    : chooseByOpen<Met::either>(bands, query, headings, count, bounds);
}

POLYLOC_HOT_LOOP
void boundCostsOfBins(const SearchTree::Bands& bands, const BandQuery& query,
                      const std::uint32_t* headings, std::size_t count, unsigned* bounds) {
  query.is_in_phase ? chooseByOpen<Met::common>(bands, query, headings, count, bounds)
                    : chooseByOpen<Met::entry>(bands, query, headings, count, bounds);
}

}  // namespace mrpt_polyloc
