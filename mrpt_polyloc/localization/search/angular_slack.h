#pragma once

#include <mrpt_polyloc/localization/search/RangeBands.h>

namespace mrpt_polyloc {

/// Bins are taken to be wider by this at both ends [rad] when ranges are bounded. What it is for,
/// and that it is enough, stands below; a scan at the worst case is tested
/// (Certificate.HoldsForBeamsThatUseUpTheAngularSlack).
constexpr double kAngularSlack = 2e-5;

/// Beams of a scan may be off its phase by so much of a bin, each way: what is left of a regular
/// scanner's spacing after logs have rounded it.
constexpr double kInPhase = 4e-4;

namespace slack {

constexpr double kOffPhase = kInPhase * kBandBinWidth;  ///< 1.40e-5
/// A vertex' bearing from the middle of a leaf, and by how much it differs from other points of it.
constexpr double kAtan2 = 2 * 4e-7;
/// Single precision, along a chain that has turned up to four times (below 32 rad; half a unit in
/// the last place is 2^-20): the whole turns added, the difference added, the slack added.
constexpr double kTurns = 3.0 / (1 << 20);
/// The same when that becomes a number of bins (below 1024).
constexpr double kToBins = 0.5 / (1 << 14) * kBandBinWidth;

static_assert(kOffPhase + kAtan2 + kTurns + kToBins < kAngularSlack, "the slack is used up");

}  // namespace slack
}  // namespace mrpt_polyloc
