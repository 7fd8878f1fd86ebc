#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/localization/search/lanes.h>
#include <mrpt_polyloc/localization/search/view_cost.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using lanes::load, lanes::takeMin, lanes::takeMax, lanes::subtractSaturated, lanes::select;
using lanes::Words;

constexpr std::size_t kLanes = lanes::kBytes / sizeof(std::uint16_t);
constexpr lanes::FirstLanes<std::uint16_t, kBandBins % kLanes> kLast;

constexpr auto kClip = static_cast<std::uint16_t>(kMostClipped / SearchTree::kViewUnit);

struct Sums {
  unsigned costs, clipped;
};

/// RobustCost, in integers.
template <bool is_in_phase, bool has_no_returns>
POLYLOC_LANES Sums sumCosts(const SearchTree::View& view, const BandQuery& query,
                            std::size_t heading) {
  Words sums{}, sums_clipped{}, cap_long = Words{} + query.cap_long_view;
  for (std::size_t first = 0; first < kBandBins; first += kLanes) {
    const std::size_t rotated = first + kBandBins - heading;
    if (!query.informs_from[rotated]) continue;
    Words near, wall, short_range, passed;
    load(view.near + first, near);
    load(view.wall + first, wall);
    if (!is_in_phase) {
      Words next;
      load(view.near + first + 1, next);
      takeMin(near, next);
      load(view.wall + first + 1, next);
      takeMax(wall, next);
    }
    load(query.short_view.data() + rotated, short_range);
    load(query.long_view.data() + rotated, passed);
    subtractSaturated(passed, wall);
    Words cap = cap_long;
    if (has_no_returns) {
      Words no_return;
      load(query.no_return_view.data() + rotated, no_return);
      select(no_return, Words{} + query.cap_none_view, cap);
      cap &= ~(no_return & (near < wall));  // past an open edge, nothing need return
    }
    takeMin(passed, cap);
    Words beyond_open = wall;
    subtractSaturated(beyond_open, short_range);
    takeMin(beyond_open, Words{} + query.cap_open_view);
    beyond_open &= short_range >= near;
    subtractSaturated(near, short_range);
    takeMin(near, Words{} + query.cap_short_view);
    Words costs = near + beyond_open + passed;
    if (first + kLanes > kBandBins) {
      Words last;
      load(kLast.mask, last);
      costs &= last;
    }
    sums += costs;
    takeMin(costs, Words{} + kClip);
    sums_clipped += costs;
  }
  return {lanes::sumOf(sums), lanes::sumOf(sums_clipped)};
}

template <bool has_no_returns>
POLYLOC_LANES Sums chooseByPhase(const SearchTree::View& view, const BandQuery& query,
                                 std::size_t heading) {
  return query.is_in_phase ? sumCosts<true, has_no_returns>(view, query, heading)
                           : sumCosts<false, has_no_returns>(view, query, heading);
}

/// Squares of differences to what the bin shows.
double sumSquares(const SearchTree::View& view, const BandQuery& query, std::size_t heading) {
  double sum = 0.0;
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const std::size_t rotated = b + kBandBins - heading;
    if (query.long_view[rotated] == 0) continue;  // no beam
    const std::size_t last = query.is_in_phase ? b : b + 1;
    const auto [near, far] = std::minmax(view.wall[b], view.wall[last]);
    const double z = query.long_view[rotated];
    const double off = std::max({near - z, z - far, 0.0});
    sum += off * off;
  }
  return sum;
}

}  // namespace

POLYLOC_HOT_LOOP
ViewCost viewCost(const SearchTree::View& view, const BandQuery& query, std::size_t heading) {
  const auto beams = static_cast<double>(query.beams.size());
  if (query.metric == SearchMetric::polar) {
    const auto cost = static_cast<float>(std::sqrt(sumSquares(view, query, heading) / beams) *
                                         SearchTree::kViewUnit);
    return {cost, cost};
  }
  const Sums sums = query.has_no_returns ? chooseByPhase<true>(view, query, heading)
                                         : chooseByPhase<false>(view, query, heading);
  return {static_cast<float>(sums.costs * SearchTree::kViewUnit / beams),
          static_cast<float>(sums.clipped * SearchTree::kViewUnit / beams)};
}

}  // namespace mrpt_polyloc
