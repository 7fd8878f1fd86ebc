#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/angular_slack.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrpt_polyloc {
namespace {

static_assert(QuantizedRange::kReach == ScanCost::kReach, "one metric for bounds and poses");

double placeOf(const Beam& beam) {
  return wrapToTwoPi(beam.bearing) / kBandBinWidth;
}

double offPhase(double place, double phase) {
  return std::remainder(place - phase, 1.0);
}

/// The phase [bins] that most beams share, and how many do.
std::pair<double, std::size_t> commonPhase(const std::vector<Beam>& beams) {
  std::vector<double> phases;
  for (const Beam& beam : beams) {
    const double place = placeOf(beam);
    phases.push_back(place - std::floor(place));
  }
  std::sort(phases.begin(), phases.end());
  std::pair<double, std::size_t> best{0.0, 0};
  const std::size_t n = phases.size();
  for (std::size_t i = 0, last = 0; i < n; ++i) {
    // From beam i on, once around the circle of phases.
    const auto at = [&](std::size_t k) { return phases[k % n] + (k >= n ? 1.0 : 0.0); };
    last = std::max(last, i);
    while (last + 1 < i + n && at(last + 1) - phases[i] < kInPhase) ++last;
    if (last - i + 1 > best.second) best = {phases[i] + 0.5 * (at(last) - phases[i]), last - i + 1};
  }
  return best;
}

}  // namespace

BandQuery::BandQuery(const RangeScan& scan, const RobustCostParams& cost,
                     SearchMetric search_metric)
    : metric(search_metric) {
  std::vector<Beam> informative;
  for (const Beam& beam : scan.beams()) {
    const bool is_robust = metric == SearchMetric::robust;
    if (beam.kind == BeamKind::hit || (is_robust && beam.kind == BeamKind::no_return)) {
      informative.push_back(beam);
    }
  }
  const ChosenBeams chosen = choose(informative);
  for (const Beam* beam : chosen) {
    if (beam != nullptr) beams.push_back(*beam);
  }
  for (std::size_t i = 0; i < kRoom; ++i) {
    for (std::size_t k = i; k < std::min(i + kLanes, kRoom) && !informs_from[i]; ++k) {
      informs_from[i] = chosen[k % kBandBins] != nullptr;
    }
    const Beam* beam = chosen[i % kBandBins];
    if (beam == nullptr || beam->kind != BeamKind::no_return) continue;
    no_return[i] = 0xFF;
    no_return_view[i] = 0xFFFF;
    has_no_returns = true;
  }
  takeRanges(chosen, cost);
  takeViewRanges(chosen, cost);
}

/// Sets the phase.
BandQuery::ChosenBeams BandQuery::choose(const std::vector<Beam>& informative) {
  const auto [common, in_phase] = commonPhase(informative);
  std::array<bool, kBandBins> is_occupied{};
  for (const Beam& beam : informative) {
    is_occupied[static_cast<std::size_t>(placeOf(beam)) % kBandBins] = true;
  }
  // Enough: most of the bins that could be filled; some beams may be invalid.
  const auto occupied =
      static_cast<std::size_t>(std::count(is_occupied.begin(), is_occupied.end(), true));
  is_in_phase = 2 * in_phase >= occupied;
  const double shift = is_in_phase ? common : 0.0;
  phase = shift * kBandBinWidth;
  ChosenBeams chosen{};
  std::array<double, kBandBins> distance;
  distance.fill(2.0);
  for (const Beam& beam : informative) {
    const double place = placeOf(beam);
    double off = offPhase(place, shift);
    if (is_in_phase && std::abs(off) > kInPhase) continue;
    const double begin = is_in_phase ? place - off : std::floor(place);
    off = std::abs(place - begin) + (beam.kind == BeamKind::no_return ? 1.0 : 0.0);
    const auto bin =
        static_cast<std::size_t>(std::lround(begin - shift) + static_cast<long>(kBandBins)) %
        kBandBins;
    if (off < distance[bin]) {
      distance[bin] = off;
      chosen[bin] = &beam;
    }
  }
  return chosen;
}

void BandQuery::takeRanges(const ChosenBeams& chosen, const RobustCostParams& cost) {
  for (std::size_t scale = 0; scale < QuantizedRange::kScales; ++scale) {
    Scaled& to = scaled[scale];
    const double cap_gap = std::min(cost.tau_short, cost.tau_long);
    to.cap_short = QuantizedRange::down(cost.tau_short, scale);
    to.cap_long = QuantizedRange::down(cost.tau_long, scale);
    to.cap_none = QuantizedRange::down(cost.tau_none, scale);
    to.cap_gap = QuantizedRange::down(cap_gap, scale);
    to.cap_open_gap = QuantizedRange::down(std::min(cap_gap, cost.tau_open), scale);
    if (metric == SearchMetric::polar) {
      to.cap_short = to.cap_long = to.cap_gap = to.cap_open_gap = QuantizedRange::kGreatest;
    }
    for (std::size_t i = 0; i < kRoom; ++i) {
      const Beam* beam = chosen[i % kBandBins];
      const bool is_hit = beam != nullptr && beam->kind == BeamKind::hit;
      to.short_range[i] =
          is_hit ? QuantizedRange::up(beam->range, scale) : QuantizedRange::kGreatest;
      to.long_range[i] = beam == nullptr ? 0
                         : is_hit        ? QuantizedRange::down(beam->range, scale)
                                  : QuantizedRange::down(cost.none_share * beam->range, scale);
    }
  }
  constexpr int kMostOfAByte = QuantizedRange::kGreatest / kVectors;
  const Scaled& finest = scaled[0];
  has_wide_caps = std::max({finest.cap_short, finest.cap_long, finest.cap_none}) > kMostOfAByte;
}

void BandQuery::takeViewRanges(const ChosenBeams& chosen, const RobustCostParams& cost) {
  const auto in_units = [](double meters, double most = 65535.0) {
    return static_cast<std::uint16_t>(std::clamp(meters / SearchTree::kViewUnit, 0.0, most));
  };
  constexpr double kGreatestCap = 65535 / 6;  // sums of words must not overflow
  cap_short_view = in_units(cost.tau_short, kGreatestCap);
  cap_long_view = in_units(cost.tau_long, kGreatestCap);
  cap_open_view = in_units(cost.tau_open, kGreatestCap);
  cap_none_view = in_units(cost.tau_none, kGreatestCap);
  for (std::size_t i = 0; i < kRoom; ++i) {
    const Beam* beam = chosen[i % kBandBins];
    short_view[i] = 0xFFFF;
    if (beam == nullptr) continue;
    const bool is_hit = beam->kind == BeamKind::hit;
    if (is_hit) short_view[i] = in_units(beam->range);
    long_view[i] = in_units(is_hit ? beam->range : cost.none_share * beam->range);
  }
}

double BandQuery::meters(unsigned units) const {
  const double mean = static_cast<double>(units) / static_cast<double>(beams.size());
  return (metric == SearchMetric::polar ? std::sqrt(mean) : mean) * QuantizedRange::kFinestUnit;
}

unsigned BandQuery::units(double meters) const {
  const double each = meters / QuantizedRange::kFinestUnit;
  const double sum =
      (metric == SearchMetric::polar ? each * each : each) * static_cast<double>(beams.size());
  constexpr auto kMost = std::numeric_limits<unsigned>::max();
  return sum < static_cast<double>(kMost) ? static_cast<unsigned>(sum) : kMost;
}

}  // namespace mrpt_polyloc
