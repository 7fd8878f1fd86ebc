#pragma once

#include <mrpt_polyloc/localization/nearest_cells/ScanViewParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <limits>
#include <optional>

namespace mrpt_polyloc {

/// A scan as the polar coordinate metric sees it.
struct ScanView {
  SampledPolarFunction samples;
  /// How far the sensor can see at all: views must be cut off there to be compared [m]; infinite
  /// where that is beyond `range`.
  double reach = std::numeric_limits<double>::infinity();
};

/// The polar function of the hits of a scan, sampled in the beam frame. Between hits that are
/// farther apart than bridged_gap nothing is seen: what a no-return says (glass, black paint, or
/// truly nothing within reach) is left to the ranking.
/// \returns nothing for a scan of fewer than two different directions of hits, or whose hits fall
/// between the samples.
std::optional<ScanView> viewOfScan(const RangeScan& scan, const ScanViewParams& params = {});

}  // namespace mrpt_polyloc
