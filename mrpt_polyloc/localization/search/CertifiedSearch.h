#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/Certificate.h>
#include <mrpt_polyloc/localization/search/CertifiedSearchParams.h>
#include <mrpt_polyloc/localization/search/PoseCandidate.h>
#include <mrpt_polyloc/localization/search/PoseScorer.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// A leaf and a window of headings, of kWindow[0] bins, that could not be excluded.
struct RemainingLeaf {
  std::uint32_t leaf;     ///< of the SearchTree
  std::uint16_t heading;  ///< first bin, of BandQuery::heading()
  float bound;            ///< no pose of it has a lower search cost [m]
};

struct CertifiedSearchResult {
  /// Starting points for refinement, the best first: seeds, optima found when the regions were
  /// settled, and the deeper bottoms beside the best of these.
  std::vector<PoseCandidate> candidates;
  /// Every pose that the prior allows whose search cost is at most `certified_cost` lies in one of
  /// these.
  std::vector<RemainingLeaf> regions;
  /// [m]; none if a budget ended the search before anything was proven, or no beam took part.
  std::optional<double> certified_cost;
  double least_cost = 0.0;  ///< search cost of the best pose found; infinity if there is none [m]
  /// No pose that the prior allows has a lower search cost [m]; 0 where a budget ended the search.
  double at_least = 0.0;
  /// Whether certified_cost reaches the least search cost found plus the margin; false where a
  /// budget ended the search.
  bool is_complete = true;
  SettledRegions settled;     ///< what became of the regions
  std::size_t evaluated = 0;  ///< nodes whose bound was computed
};

/// Branch and bound over (leaf, window of headings). The limit rises in a few steps, until it
/// reaches the least cost that the poses found on the way have once refined, plus the margin. What
/// is bounded above it is left out; what remains of the leaves are the regions, which are then
/// settled (see settleLeaves()).
///
/// \param sensor the beams' origin in the robot frame, to hold `prior`, which speaks of the robot,
/// against
CertifiedSearchResult searchTree(const SearchTree& tree, const BandQuery& query,
                                 const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                 const PoseScorer& scorer, const Budget& budget = Budget(),
                                 const CertifiedSearchParams& params = {});

}  // namespace mrpt_polyloc
