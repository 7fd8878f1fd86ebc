#pragma once

#include <mrpt_polyloc/localization/ranking/Assessment.h>
#include <mrpt_polyloc/localization/ranking/hypotheses.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Says what the refined poses mean.
///
/// The status is no_match where the probability that the scan was taken in this map is below
/// least_match_probability; unique where that probability times the weight of the first hypothesis
/// reaches unique_probability; else ambiguous. Then hypotheses of one valley become one
/// (valleys.h), if the params say so.
/// \param poses sorted by cost, merged; all that may be rivals, whether they are returned or not
/// \param cost of the scan, as the poses were ranked by
/// \param max_hypotheses at most so many are returned; weights are of all poses, so that those
/// returned may sum to less than 1
Assessment assess(const std::vector<ScoredPose>& poses, const RangeScan& scan, const ScanCost& cost,
                  const HypothesisParams& params, std::size_t max_hypotheses);

}  // namespace mrpt_polyloc
