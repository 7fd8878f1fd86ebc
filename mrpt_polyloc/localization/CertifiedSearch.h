#pragma once

#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/PoseCandidate.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

struct CertifiedSearchParams {
  /// Poses whose search cost is within this share of the least one found, plus `margin`, are kept:
  /// the cost is noisy, and the right pose does not always have the least.
  double margin_share = 0.1;
  double margin = 0.01;  ///< [m]
  /// Of the poses kept, those whose cost in the middle of their cell is within this share of the
  /// best such cost, plus `start_margin`, are starting points for refinement.
  double start_share = 0.3;
  double start_margin = 0.08;        ///< [m]
  std::size_t max_candidates = 200;  ///< the best so many of them
  /// Nodes evaluated at most before the search stops and says up to which cost it is certified; 0:
  /// no limit.
  std::size_t max_nodes = 0;
  double time_budget_ms = 0.0;  ///< the same for wall time [ms]; results then depend on the machine

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A cell and a window of headings, of kWindow[0] bins, that could not be excluded.
struct RemainingCell {
  std::uint32_t cell;     ///< of the CellTree
  std::uint16_t heading;  ///< first bin, of BandQuery::heading()
  float bound;            ///< no pose of it has a lower search cost [m]
};

struct CertifiedSearchResult {
  std::vector<PoseCandidate> candidates;  ///< starting points for refinement, best first
  /// Every pose that the prior allows whose search cost is at most `certified_cost` lies in one of
  /// these.
  std::vector<RemainingCell> regions;
  double certified_cost = 0.0;  ///< [m]
  /// Whether certified_cost reaches the least search cost found plus the margin; false where a
  /// budget ended the search.
  bool is_complete = true;
  std::size_t evaluated = 0;  ///< nodes whose bound was computed
};

/// Moves a pose of the beam frame to where the scan fits better; returns its search cost [m].
using RefinedCost = std::function<double(const mrpt::math::TPose2D& pose_map_beams)>;

/// Branch and bound over (cell, window of headings). The limit rises in a few steps, until it
/// reaches the least cost that the poses found on the way have once refined, plus the margin. What
/// is bounded above it is left out; what remains of the cells are the regions.
///
/// \param sensor the beams' origin in the robot frame, to hold `prior`, which speaks of the robot,
/// against
CertifiedSearchResult searchCells(const CellTree& tree, const BandQuery& query,
                                  const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                  const RefinedCost& refined_cost,
                                  const CertifiedSearchParams& params = {});

}  // namespace mrpt_polyloc
