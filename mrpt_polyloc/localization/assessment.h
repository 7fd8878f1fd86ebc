#pragma once

#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/RangeScan.h>
#include <mrpt_polyloc/localization/ScanCost.h>
#include <mrpt_polyloc/localization/hypotheses.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Says what the refined poses mean: fills status, match probability, features and hypotheses of a
/// result.
///
/// The status is no_match where the probability that the scan was taken in this map is below
/// least_match_probability; unique where that probability times the weight of the first hypothesis
/// reaches unique_probability; else ambiguous.
/// \param poses sorted by cost, merged; all that may be rivals, whether they are returned or not
/// \param cost of the scan, as the poses were ranked by
/// \param max_hypotheses at most so many are returned; their weights sum to 1
void assess(const std::vector<RankedPose>& poses, const RangeScan& scan, const ScanCost& cost,
            const HypothesisParams& params, std::size_t max_hypotheses, LocalizationResult& result);

}  // namespace mrpt_polyloc
