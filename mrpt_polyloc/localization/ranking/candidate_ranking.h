#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/ranking/Assessment.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/AllowedPoses.h>
#include <mrpt_polyloc/localization/scan/PoseRefinerParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// How candidates of any search become hypotheses.
struct RankingParams {
  std::size_t max_hypotheses = 20;  ///< at most so many are returned
  RobustCostParams cost;
  PoseRefinerParams refinement;
  HypothesisParams hypotheses;
};

/// Candidates refined with some of the beams, the best of them with all, within what is allowed;
/// merged where they are nearly one, compared by their robust cost over all beams, and ranked by
/// the evidence.
/// \param candidates poses of the beam frame in the map, any order
/// \param budget ends the refinement early: the rest stays as it came
/// \returns status unique, ambiguous or no_match, and the hypotheses
Assessment rankCandidates(const std::vector<mrpt::math::TPose2D>& candidates, const RangeScan& scan,
                          const AllowedPoses& allowed, const RangePredictor& predictor,
                          const RankingParams& params = {}, const Budget& budget = Budget());

}  // namespace mrpt_polyloc
