#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/lanes.h>

namespace mrpt_polyloc {
namespace {

using lanes::load, lanes::lower, lanes::raise, lanes::takeExcess;
using lanes::Words;

constexpr std::size_t kLanes = lanes::kBytes / sizeof(std::uint16_t);
constexpr lanes::FirstLanes<std::uint16_t, kBandBins % kLanes> kLast;

/// RobustCost, in integers.
template <bool is_in_phase>
POLYLOC_LANES unsigned sumCosts(const CellTree::View& view, const BandQuery& query,
                                std::size_t heading) {
  Words sums{};
  for (std::size_t first = 0; first < kBandBins; first += kLanes) {
    const std::size_t rotated = first + kBandBins - heading;
    if (!query.informs_from[rotated]) continue;
    Words near, wall, short_range, passed, cap_long, no_return;
    load(view.near + first, near);
    load(view.wall + first, wall);
    if (!is_in_phase) {
      Words next;
      load(view.near + first + 1, next);
      lower(near, next);
      load(view.wall + first + 1, next);
      raise(wall, next);
    }
    load(query.short_view.data() + rotated, short_range);
    load(query.long_view.data() + rotated, passed);
    load(query.cap_long_view.data() + rotated, cap_long);
    load(query.no_return_view.data() + rotated, no_return);
    takeExcess(passed, wall);
    lower(passed, cap_long);
    passed &= ~(no_return & (near < wall));  // past an open edge, nothing need return
    Words beyond_open = wall;
    takeExcess(beyond_open, short_range);
    lower(beyond_open, Words{} + query.cap_open_view);
    beyond_open &= short_range >= near;
    takeExcess(near, short_range);
    lower(near, Words{} + query.cap_short_view);
    Words costs = near + beyond_open + passed;
    if (first + kLanes > kBandBins) {
      Words last;
      load(kLast.mask, last);
      costs &= last;
    }
    sums += costs;
  }
  return lanes::sumOf(sums);
}

}  // namespace

POLYLOC_HOT_LOOP
float viewCost(const CellTree::View& view, const BandQuery& query, std::size_t heading) {
  const unsigned sum = query.is_in_phase ? sumCosts<true>(view, query, heading)
                                         : sumCosts<false>(view, query, heading);
  return static_cast<float>(sum * CellTree::kViewUnit / static_cast<double>(query.beams.size()));
}

}  // namespace mrpt_polyloc
