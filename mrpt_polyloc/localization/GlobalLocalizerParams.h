#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>
#include <mrpt_polyloc/localization/scan/PoseRefinerParams.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>
#include <mrpt_polyloc/localization/search/CertifiedSearchParams.h>

#include <cstddef>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT GlobalLocalizerParams {
  /// Scans with fewer hits are not searched for: so few fit almost everywhere.
  std::size_t least_hits = 15;
  /// By which refined poses are compared, and merged where they are nearly one; what
  /// Hypothesis::cost is. (They are ranked by hypotheses.evidence.)
  RobustCostParams cost;
  /// The search's cost: wider truncations, by which wrong poses stand out more, so that bounds
  /// exclude more.
  RobustCostParams search_cost{1.2, 2.0, 0.6, 0.3, RobustCostParams{}.none_share};
  CertifiedSearchParams certified;
  PoseRefinerParams refinement;
  HypothesisParams hypotheses;
  /// Of scan sets: how much scans from nearly the same place count.
  ScanCorrelation correlation;
  /// ... and so many of its scans are searched at most, now first, then the farthest from those
  /// searched ...
  std::size_t most_searched_scans = 4;
  /// ... but no more once the first answer is right with this probability (its weight times that of
  /// a match).
  double sure_probability = 0.95;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
