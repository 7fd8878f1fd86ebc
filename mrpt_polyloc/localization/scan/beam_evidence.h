#pragma once

#include <mrpt_polyloc/localization/scan/BeamEvidenceParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <vector>

namespace mrpt_polyloc {

/// What speaks against a pose, beam by beam [m]: RobustCost with two changes that rank the poses of
/// a finished search better than the cost it was searched by. Beams that end before the map's wall
/// may cost a little more, and beyond that something for each metre of predicted view that they do
/// not reach: a large part of a room is rarely hidden.
/// Differences of ranges count as far as they exceed BeamEvidenceParams::tolerance, and are capped
/// then.
/// Measured on the best 50 of the seven sets of evaluation data: see doc/localization.md.
/// \param beams hits and no-returns \param predicted for these beams, in their order
std::vector<float> beamEvidence(const std::vector<Beam>& beams, const PredictedRanges& predicted,
                                const BeamEvidenceParams& params = {});

}  // namespace mrpt_polyloc
