#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/RangeCode.h>
#include <mrpt_polyloc/localization/SignatureQuery.h>

#include <cmath>
#include <limits>

namespace mrpt_polyloc {

void SignatureCosts::check() const {
  constexpr double kGreatest = 63.0;
  requireInRange("cap_short", cap_short, 0.0, kGreatest);
  requireInRange("cap_long", cap_long, 0.0, kGreatest);
  requireInRange("cap_open", cap_open, 0.0, kGreatest);
  requireInRange("cap_none", cap_none, 0.0, kGreatest);
}

SignatureQuery::SignatureQuery(const RangeScan& scan, const SignatureCosts& costs,
                               double none_share) {
  constexpr double kBinsPerRadian = static_cast<double>(kBins) / kTwoPi;
  std::array<const Beam*, kBins> chosen{};
  std::array<double, kBins> distance;
  distance.fill(std::numeric_limits<double>::infinity());
  for (const Beam& beam : scan.beams()) {
    if (beam.kind == BeamKind::invalid) continue;
    // Within half a circle of 0: any finite bearing has a bin.
    const double place = std::remainder(beam.bearing, kTwoPi) * kBinsPerRadian;
    const double nearest = std::nearbyint(place);
    const auto bin =
        static_cast<std::size_t>(static_cast<int>(nearest) + static_cast<int>(kBins)) % kBins;
    const double off_centre =
        std::abs(place - nearest) + (beam.kind == BeamKind::no_return ? 1.0 : 0.0);
    if (off_centre < distance[bin]) {
      distance[bin] = off_centre;
      chosen[bin] = &beam;
    }
  }
  for (std::size_t i = 0; i < 2 * kBins; ++i) {
    const Beam* beam = chosen[i % kBins];
    if (beam == nullptr) continue;
    if (beam->kind == BeamKind::hit) {
      range[i] = RangeCode::encode(static_cast<float>(beam->range));
      cap_short[i] = costs.cap_short;
      cap_long[i] = costs.cap_long;
      cap_open[i] = costs.cap_open;
    } else {
      range[i] = RangeCode::encode(static_cast<float>(none_share * beam->range));
      cap_long[i] = costs.cap_none;
    }
    used_bins += i < kBins;
    // Bin i informs every run of 64 that holds it.
    for (std::size_t first = i < 63 ? 0 : i - 63; first <= i; ++first) informs_from_[first] = true;
  }
}

}  // namespace mrpt_polyloc
