#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/lanes.h>

namespace mrpt_polyloc {
namespace {

using lanes::Bytes, lanes::Words;
using lanes::load, lanes::lower, lanes::raise, lanes::takeExcess, lanes::blend;

constexpr std::size_t kLanes = BandQuery::kLanes;
static_assert(kLanes == lanes::kBytes && CellTree::kStride == BandQuery::kVectors * kLanes);
/// The entries of the last vector that still are bins; the rest of an array repeats its begin.
constexpr lanes::FirstLanes<std::uint8_t, kBandBins % kLanes> kLast;

/// Sums of bytes side by side: in bytes where the caps allow that, else in words.
template <bool is_wide>
struct Sums;
template <>
struct Sums<false> {
  Bytes bytes{};
  POLYLOC_LANES void add(const Bytes& costs) { bytes += costs; }
  POLYLOC_LANES void words(Words& sums) const {
    const Words pairs = reinterpret_cast<const Words&>(bytes);
    sums = (pairs & 0xFF) + (pairs >> 8);
  }
};
template <>
struct Sums<true> {
  Words pairs{};
  POLYLOC_LANES void add(const Bytes& costs) {
    const Words more = reinterpret_cast<const Words&>(costs);
    pairs += (more & 0xFF) + (more >> 8);
  }
  POLYLOC_LANES void words(Words& sums) const { sums = pairs; }
};

/// The cases of BinBand: at most one of them costs a beam anything.
template <bool has_open, bool is_in_phase, bool has_no_returns, bool is_wide>
POLYLOC_LANES unsigned sumCosts(const CellTree::Bands& bands,
                                                        const BandQuery& query,
                                                        std::size_t heading) {
  const BandQuery::Scaled& scan = query.scaled[bands.scale];
  Sums<is_wide> sums;
  for (std::size_t first = 0; first < kBandBins; first += kLanes) {
    const std::size_t rotated = first + kBandBins - heading;
    if (!query.informs_from[rotated]) continue;
    Bytes near_low, wall_high, gap_low, gap_high, short_range, long_range;
    load(bands.near_low + first, near_low);
    load(bands.wall_high + first, wall_high);
    load(bands.gap_low + first, gap_low);
    load(bands.gap_high + first, gap_high);
    load(scan.short_range.data() + rotated, short_range);
    load(scan.long_range.data() + rotated, long_range);
    Bytes may_be_open = gap_low & 1;
    if (!is_in_phase) {  // a beam may meet the next bin, too
      Bytes next;
      load(bands.near_low + first + 1, next);
      lower(near_low, next);
      load(bands.wall_high + first + 1, next);
      raise(wall_high, next);
      load(bands.gap_low + first + 1, next);
      may_be_open |= next & 1;
      raise(gap_low, next);
      load(bands.gap_high + first + 1, next);
      lower(gap_high, next);
    }
    Bytes beyond = long_range, cap_long = Bytes{} + scan.cap_long, cap_gap = Bytes{} + scan.cap_gap;
    takeExcess(beyond, wall_high);
    if (has_no_returns) {
      Bytes no_return;
      load(query.no_return.data() + rotated, no_return);
      blend(no_return, Bytes{} + scan.cap_none, cap_long);
      // Past an open edge, nothing need return.
      if (has_open) blend(no_return & (Bytes{} - may_be_open), Bytes{}, cap_long);
    }
    lower(beyond, cap_long);
    takeExcess(near_low, short_range);
    lower(near_low, Bytes{} + scan.cap_short);
    if (has_open) blend(Bytes{} - may_be_open, Bytes{} + scan.cap_open_gap, cap_gap);
    takeExcess(long_range, gap_low);
    takeExcess(gap_high, short_range);
    lower(gap_high, long_range);
    lower(gap_high, cap_gap);
    Bytes costs = near_low + beyond + gap_high;
    if (first + kLanes > kBandBins) {
      Bytes last;
      load(kLast.mask, last);
      costs &= last;
    }
    sums.add(costs);
  }
  Words words;
  sums.words(words);
  return lanes::sumOf(words) << bands.scale;
}

template <bool has_open, bool is_in_phase>
POLYLOC_LANES unsigned chooseByReturns(const CellTree::Bands& bands,
                                                               const BandQuery& query,
                                                               std::size_t heading) {
  if (query.has_wide_caps) return sumCosts<has_open, is_in_phase, true, true>(bands, query, heading);
  return query.has_no_returns ? sumCosts<has_open, is_in_phase, true, false>(bands, query, heading)
                              : sumCosts<has_open, is_in_phase, false, false>(bands, query, heading);
}

}  // namespace

POLYLOC_HOT_LOOP
unsigned bandCost(const CellTree::Bands& bands, const BandQuery& query, std::size_t heading) {
  if (query.is_in_phase) {
    return bands.has_open ? chooseByReturns<true, true>(bands, query, heading)
                          : chooseByReturns<false, true>(bands, query, heading);
  }
  return bands.has_open ? chooseByReturns<true, false>(bands, query, heading)
                        : chooseByReturns<false, false>(bands, query, heading);
}

}  // namespace mrpt_polyloc
