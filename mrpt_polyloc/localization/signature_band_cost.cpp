#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/localization/PyramidSearch.h>

#include <cstring>

namespace mrpt_polyloc {
namespace {

/// Bins that are summed side by side: one AVX-512 register, or two of AVX2, or four of SSE2.
/// Written with the compiler's vector type, as g++ 12 leaves loops over bytes with these selects
/// scalar.
constexpr std::size_t kLanes = 64;
using Lanes = std::uint8_t __attribute__((vector_size(kLanes)));

inline __attribute__((always_inline)) void load(const std::uint8_t* from, Lanes& to) {
  std::memcpy(&to, from, kLanes);
}

}  // namespace

// With z the scan's code: z below near_low falls short of all; z between near_high and wall_low has
// passed an open edge everywhere and ends before every wall; z above wall_high has passed every
// wall.
POLYLOC_HOT_LOOP
unsigned bandCost(const SignatureBand& band, const SignatureQuery& query, std::size_t heading) {
  Lanes sums{};  // at most kBins / kLanes caps of at most 63 each
  for (std::size_t first = 0; first < kBins; first += kLanes) {
    const std::size_t rotated = first + kBins - heading;
    if (!query.informsFrom(rotated)) continue;
    Lanes near_low, near_high, wall_low, wall_high, z, cap_short, cap_long, cap_open;
    load(band.near_low + first, near_low);
    load(band.near_high + first, near_high);
    load(band.wall_low + first, wall_low);
    load(band.wall_high + first, wall_high);
    load(query.range.data() + rotated, z);
    load(query.cap_short.data() + rotated, cap_short);
    load(query.cap_long.data() + rotated, cap_long);
    load(query.cap_open.data() + rotated, cap_open);
    // max(a, b) - b is a - b where that is positive, else 0.
    Lanes before = (near_low > z ? near_low : z) - z;
    before = before < cap_short ? before : cap_short;
    Lanes within = (wall_low > z ? wall_low : z) - z;
    within = within < cap_open ? within : cap_open;
    within = z >= near_high ? within : Lanes{};
    Lanes beyond = (z > wall_high ? z : wall_high) - wall_high;
    beyond = beyond < cap_long ? beyond : cap_long;
    sums += before + within + beyond;
  }
  std::uint8_t lanes[kLanes];
  std::memcpy(lanes, &sums, kLanes);
  unsigned sum = 0;
  for (const std::uint8_t lane : lanes) sum += lane;
  return sum;
}

}  // namespace mrpt_polyloc
