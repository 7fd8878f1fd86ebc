#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
#include <mrpt_polyloc/localization/nearest_cells/scan_view.h>
#include <mrpt_polyloc/polar/CirclePlan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// A hit by its direction in [0, 2 pi).
using Hit = std::pair<double, double>;

std::vector<Hit> hitsByBearing(const RangeScan& scan, double range) {
  std::vector<Hit> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    hits.emplace_back(wrapToTwoPi(beam.bearing), std::min(beam.range, range));
  }
  std::sort(hits.begin(), hits.end());
  return hits;
}

/// Each range replaced by the median of five neighbours: single beams that ended early, on dust or
/// a chair's leg, would weigh most in a sum of squares. Within the field of view: the ends keep
/// theirs.
void removeSpikes(std::vector<Hit>& hits) {
  const std::vector<Hit> raw = hits;
  for (std::size_t i = 2; i + 2 < raw.size(); ++i) {
    std::array<double, 5> window{};
    for (std::size_t j = 0; j < window.size(); ++j) window[j] = raw[i + j - 2].second;
    std::nth_element(window.begin(), window.begin() + 2, window.end());
    hits[i].second = window[2];
  }
}

/// The range between two hits at `share` of the way in angle: that of the hit nearer in angle;
/// across a bridged gap in proportion.
double rangeBetween(const Hit& a, const Hit& b, double share, bool bridged) {
  if (bridged) return a.second + share * (b.second - a.second);
  return share < 0.5 ? a.second : b.second;
}

/// How far no-returns say that the sensor reaches, or infinity.
double reachOf(const RangeScan& scan, double range) {
  double reach = std::numeric_limits<double>::infinity();
  for (const Beam& beam : scan.beams()) {
    if (beam.kind == BeamKind::no_return) reach = std::min(reach, beam.range);
  }
  return reach < range ? reach : std::numeric_limits<double>::infinity();
}

/// The usual angle between neighbouring hits: gaps up to 1.5 times that are none.
double usualSpacing(const std::vector<Hit>& hits) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < hits.size(); ++i) gaps.push_back(hits[i].first - hits[i - 1].first);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

}  // namespace

void ScanViewParams::check() const {
  requireInRange("samples", static_cast<double>(samples), 2.0 * (ViewIndex::kOrder + 1), 1e6);
  CirclePlan::forSamples(samples);
  requireInRange("range", range, 0.1, 1e4);
  requireInRange("bridged_gap", bridged_gap, 0.0, kPi);
}

std::optional<ScanView> viewOfScan(const RangeScan& scan, const ScanViewParams& params) {
  std::vector<Hit> hits = hitsByBearing(scan, params.range);
  if (hits.size() < 2 || hits.front().first == hits.back().first) return std::nullopt;
  removeSpikes(hits);
  const double beam_gap = 1.5 * usualSpacing(hits);
  const double widest_gap = std::max(beam_gap, params.bridged_gap);
  hits.emplace_back(hits.front().first + kTwoPi, hits.front().second);

  const std::size_t k = params.samples;
  std::vector<float> samples(k, std::numeric_limits<float>::quiet_NaN());
  std::size_t seen = 0;
  for (std::size_t i = 0; i < k; ++i) {
    double phi = kTwoPi * static_cast<double>(i) / static_cast<double>(k);
    if (phi < hits.front().first) phi += kTwoPi;  // in the gap that closes the circle
    const auto after =
        std::upper_bound(hits.begin(), hits.end(), phi,
                         [](double angle, const Hit& hit) { return angle < hit.first; });
    if (after == hits.begin() || after == hits.end()) continue;
    const Hit &a = *(after - 1), &b = *after;
    const double gap = b.first - a.first;
    if (gap > widest_gap) continue;
    samples[i] = static_cast<float>(rangeBetween(a, b, (phi - a.first) / gap, gap > beam_gap));
    ++seen;
  }
  if (seen == 0) return std::nullopt;
  return ScanView{SampledPolarFunction(std::move(samples)), reachOf(scan, params.range)};
}

}  // namespace mrpt_polyloc
