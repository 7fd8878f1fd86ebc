#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>

namespace mrpt_polyloc {

/// See beamEvidence() and BeamEvidence.
struct POLYLOC_EXPORT BeamEvidenceParams {
  /// As the cost that candidates are compared by, but for beams that end before the map's wall: up
  /// to half a metre.
  RobustCostParams cost{0.5, RobustCostParams{}.tau_long, RobustCostParams{}.tau_open,
                        RobustCostParams{}.tau_none, RobustCostParams{}.none_share};
  /// Beyond cost.tau_short, each metre of predicted view that a beam does not reach costs so much
  /// [m/m] ...
  double hidden_cost = 0.05;
  double most_hidden = 5.0;  ///< ... up to here [m]: a large part of a room is rarely hidden

  /// Each point that lies on no wall costs so much [m], one on a wall nothing, with a Gaussian of
  /// the distance between: chosen with whole maps left out (doc/localization.md).
  double off_wall_cost = 0.15;
  double wall_sigma = 0.2;  ///< of that Gaussian [m]
  double thinning = 0.25;   ///< points in a square of this side count as one [m]

  /// Of each difference of ranges so much is the map's own, and says nothing against a pose [m]:
  /// localizers fill it in (HypothesisParams::tolerance_share).
  double tolerance = 0.0;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
