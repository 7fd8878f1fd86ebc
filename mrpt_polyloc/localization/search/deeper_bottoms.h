#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/search/PoseCandidate.h>
#include <mrpt_polyloc/localization/search/PoseScorer.h>

#include <vector>

namespace mrpt_polyloc {

struct DeeperBottoms {
  double least = 0.0;               ///< the least search cost found, the optima's included [m]
  std::vector<PoseCandidate> ends;  ///< those that cost less than the optimum they come from
};

/// Lowers optima by the cost itself.
///
/// Gauss-Newton ends where weighted squares are least; the cost, a truncated mean of absolute
/// differences, may be lower beside that: mostly by a centimetre and within centimetres, sometimes
/// in a second bottom of the same place. From each optimum, and from the cheapest of two rings of
/// poses around it, a compass search goes down: poses are tried in six directions, nearer and
/// nearer. Some 85 costs an optimum.
/// \param optima with their search costs, at least one \param budget its threads alone
DeeperBottoms deeperBottoms(const std::vector<PoseCandidate>& optima, const PoseScorer& scorer,
                            const Budget& budget = Budget());

}  // namespace mrpt_polyloc
