#pragma once

#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/hypotheses.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Says what the refined poses mean: fills status and hypotheses of a result.
///
/// \param poses sorted by cost, merged; all that may be rivals, whether they are returned or not
/// \param cost of the scan, as the poses were ranked by
/// \param max_hypotheses at most so many are returned
void assess(const std::vector<RankedPose>& poses, const RangeScan& scan, const ScanCost& cost,
            const HypothesisParams& params, std::size_t max_hypotheses, LocalizationResult& result);

}  // namespace mrpt_polyloc
