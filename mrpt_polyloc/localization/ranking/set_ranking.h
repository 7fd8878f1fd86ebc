#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/ranking/Assessment.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>
#include <mrpt_polyloc/localization/ranking/candidate_ranking.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc {

/// rankCandidates() for a scan set: candidates refined on some beams of all scans, the best of them
/// on all, merged where they are nearly one, ranked by the evidence of all scans and by how much
/// the wheels would have to be wrong, and judged.
/// \param candidates poses of the ROBOT in the map now, any order
/// \param prior of the robot now. The pose now must be allowed, those before need not: there the
/// scans themselves speak
POLYLOC_EXPORT Assessment rankCandidates(const std::vector<mrpt::math::TPose2D>& candidates,
                                         const ScanSet& set, const MomentWeights& weights,
                                         const Triangulation& triangulation, const PosePrior& prior,
                                         const RangePredictor& predictor,
                                         const RankingParams& params = {},
                                         const Budget& budget = Budget());

}  // namespace mrpt_polyloc
