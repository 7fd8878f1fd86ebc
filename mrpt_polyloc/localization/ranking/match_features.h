#pragma once

#include <mrpt_polyloc/localization/ranking/MatchFeatures.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/scan/ScoredPose.h>

#include <vector>

namespace mrpt_polyloc {

/// The features of the first pose. \param poses sorted by cost, at least one
/// \param first the one that counts as the answer \param sectors of the beams of `cost`
MatchFeatures matchFeatures(const std::vector<ScoredPose>& poses, const ScoredPose& first,
                            const ScanCost& cost, const BeamSectors& sectors);

}  // namespace mrpt_polyloc
