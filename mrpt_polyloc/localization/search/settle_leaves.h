#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/Certificate.h>
#include <mrpt_polyloc/localization/search/CertifiedSearchParams.h>
#include <mrpt_polyloc/localization/search/PoseCandidate.h>
#include <mrpt_polyloc/localization/search/PoseScorer.h>
#include <mrpt_polyloc/localization/search/SeedPoses.h>

#include <vector>

namespace mrpt_polyloc {

struct SettledLeaves {
  SettledRegions counts;
  /// Optima within the limit, cheapest first, each with its search cost.
  std::vector<PoseCandidate> optima;
};

/// Decides of the leaves that remain whether they may hold a pose cheaper than the best known.
///
/// Leaves bounded above the least cost known cannot. Of the others, those whose middle costs at
/// most CertifiedSearchParams::reach more (all, where few remain) are taken as the points of a
/// grid: each leads to the cheapest of its neighbours, a leaf or a window of headings away, until
/// none is cheaper. Refinement is started at the last, the bottom of a basin: one for hundreds of
/// leaves; and where a basin is level, as along a corridor, at one of each metre.
/// \param limit leaves bounded above are left out, and optima that cost more [units of the query]
/// \param least search cost of the best pose known [m]
/// O(leaves + n log n) for n leaves within reach, and a refinement a basin.
SettledLeaves settleLeaves(SeedPoses& leaves, unsigned limit, double least, const BandQuery& query,
                           const PoseScorer& scorer, const Budget& budget,
                           const CertifiedSearchParams& params);

}  // namespace mrpt_polyloc
