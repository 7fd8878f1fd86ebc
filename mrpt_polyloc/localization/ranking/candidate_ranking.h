#pragma once

#include <mrpt_polyloc/localization/ranking/Assessment.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
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

/// Candidates refined with some of the beams, the best of them with all, of these what the prior
/// allows, ranked by their robust cost over all beams and merged where they are nearly one.
/// \param candidates poses of the beam frame in the map, any order
/// \returns status unique, ambiguous or no_match, and the hypotheses
Assessment rankCandidates(const std::vector<mrpt::math::TPose2D>& candidates, const RangeScan& scan,
                          const PosePrior& prior, const RangePredictor& predictor,
                          const RankingParams& params);

}  // namespace mrpt_polyloc
