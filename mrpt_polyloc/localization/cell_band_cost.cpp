#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/localization/BandQuery.h>

#include <cstring>

namespace mrpt_polyloc {
namespace {

/// Bins that are summed side by side: one AVX-512 register, or two of AVX2, or four of SSE2.
constexpr std::size_t kLanes = 32;
using Lanes = std::uint16_t __attribute__((vector_size(2 * kLanes)));
static_assert(CellTree::kStride % kLanes == 0);

inline __attribute__((always_inline)) void load(const std::uint16_t* from, Lanes& to) {
  std::memcpy(&to, from, sizeof(Lanes));
}
// To be inlined, and without vectors as results, which have no one form on all machines.
inline __attribute__((always_inline)) void lower(Lanes& a, const Lanes& b) {
  a = a < b ? a : b;
}
inline __attribute__((always_inline)) void raise(Lanes& a, const Lanes& b) {
  a = a > b ? a : b;
}
/// a becomes a - b where that is positive, else 0; at most `cap`.
inline __attribute__((always_inline)) void takeExcess(Lanes& a, const Lanes& b, const Lanes& cap) {
  raise(a, b);
  a -= b;
  lower(a, cap);
}

/// The entries of the last vector that still are bins; the rest of an array repeats its begin.
constexpr std::size_t kLastBins = kBandBins % kLanes;
static_assert(kLastBins > 0);
struct LastBins {
  alignas(64) std::uint16_t mask[kLanes] = {};
  constexpr LastBins() {
    for (std::size_t i = 0; i < kLastBins; ++i) mask[i] = 0xFFFF;
  }
};
constexpr LastBins kLast;

/// With z the scan's range: z below near_low falls short of all; z above wall_high has passed every
/// wall; z between near_high and wall_low has passed an open edge everywhere and ends before every
/// wall.
template <bool has_open, bool is_in_phase, bool has_no_returns>
inline __attribute__((always_inline)) unsigned sumCosts(const CellTree::Bands& bands,
                                                        const BandQuery& query,
                                                        std::size_t heading) {
  const Lanes cap_short = Lanes{} + query.cap_short, cap_open = Lanes{} + query.cap_open;
  Lanes cap_long = Lanes{} + query.cap_long[0];
  Lanes sums{};
  for (std::size_t first = 0; first < kBandBins; first += kLanes) {
    const std::size_t rotated = first + kBandBins - heading;
    if (!query.informs_from[rotated]) continue;
    Lanes near_low, wall_high, short_range, beyond;
    load(bands.near_low + first, near_low);
    load(bands.wall_high + first, wall_high);
    load(query.short_range.data() + rotated, short_range);
    load(query.long_range.data() + rotated, beyond);
    if (!is_in_phase) {  // a beam may meet the next bin, too
      Lanes next_low, next_high;
      load(bands.near_low + first + 1, next_low);
      load(bands.wall_high + first + 1, next_high);
      const Lanes may_be_open = (wall_high | next_high) & 1;
      lower(near_low, next_low);
      raise(wall_high, next_high);
      wall_high |= may_be_open;
    }
    if (has_no_returns) load(query.cap_long.data() + rotated, cap_long);
    takeExcess(beyond, wall_high, cap_long);
    takeExcess(near_low, short_range, cap_short);
    Lanes costs = near_low;
    if (has_open) {
      if (has_no_returns) {  // past an open edge, nothing need return
        Lanes no_return;
        load(query.no_return.data() + rotated, no_return);
        beyond &= ~(no_return & (Lanes{} - (wall_high & 1)));
      }
      Lanes near_high, wall_low;
      load(bands.near_high + first, near_high);
      load(bands.wall_low + first, wall_low);
      if (!is_in_phase) {
        Lanes next_high, next_low;
        load(bands.near_high + first + 1, next_high);
        load(bands.wall_low + first + 1, next_low);
        raise(near_high, next_high);
        lower(wall_low, next_low);
      }
      takeExcess(wall_low, short_range, cap_open);
      costs += short_range >= near_high ? wall_low : Lanes{};
    }
    costs += beyond;
    if (first + kLanes > kBandBins) {
      Lanes last;
      load(kLast.mask, last);
      costs &= last;
    }
    sums += costs;
  }
  std::uint16_t lanes[kLanes];
  std::memcpy(lanes, &sums, sizeof(Lanes));
  unsigned sum = 0;
  for (const std::uint16_t lane : lanes) sum += lane;
  return sum;
}

template <bool has_open, bool is_in_phase>
inline __attribute__((always_inline)) unsigned chooseByReturns(const CellTree::Bands& bands,
                                                               const BandQuery& query,
                                                               std::size_t heading) {
  return query.has_no_returns ? sumCosts<has_open, is_in_phase, true>(bands, query, heading)
                              : sumCosts<has_open, is_in_phase, false>(bands, query, heading);
}

}  // namespace

POLYLOC_HOT_LOOP
unsigned bandCost(const CellTree::Bands& bands, const BandQuery& query, std::size_t heading) {
  const bool has_open = bands.near_high != nullptr;
  if (query.is_in_phase) {
    return has_open ? chooseByReturns<true, true>(bands, query, heading)
                    : chooseByReturns<false, true>(bands, query, heading);
  }
  return has_open ? chooseByReturns<true, false>(bands, query, heading)
                  : chooseByReturns<false, false>(bands, query, heading);
}

}  // namespace mrpt_polyloc
