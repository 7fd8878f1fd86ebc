#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/MomentWeights.h>
#include <mrpt_polyloc/localization/scan/BeamEvidence.h>
#include <mrpt_polyloc/localization/scan/BeamSectors.h>
#include <mrpt_polyloc/localization/scan/ScanCost.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc {

/// What speaks against a way through the map (the robot's pose at each moment of a scan set): the
/// evidence of every beam of every scan, and how two ways compare by it.
class POLYLOC_EXPORT SetEvidence {
 public:
  /// Beam by beam, the lasers of a moment one after the other [m].
  using Values = std::vector<std::vector<float>>;  // of each moment

  /// Keeps references to predictor, set and weights.
  SetEvidence(const RangePredictor& predictor, const ScanSet& set, const MomentWeights& weights,
              const RobustCostParams& cost = {}, const BeamEvidenceParams& evidence = {});

  /// Mean robust cost per beam, moments weighted [m].
  double cost(const std::vector<mrpt::math::TPose2D>& way) const;

  /// The same of one moment alone.
  double cost(std::size_t moment, const mrpt::math::TPose2D& pose_map_robot) const;

  /// How much a moment counts in that mean, see MomentWeights.
  double weight(std::size_t moment) const { return weights_->weights[moment]; }

  Values at(const std::vector<mrpt::math::TPose2D>& way) const;

  /// Mean evidence per beam, moments weighted [m].
  double mean(const Values& values) const;

  /// Weighted mean over the moments of b - a, with the standard error that the scatter among
  /// sectors within the moments and the correlation between them give it. For one moment with one
  /// scan it is BeamSectors::difference().
  PairedDifference difference(const Values& a, const Values& b) const;

  /// The same of the evidence itself: how well mean() is known.
  PairedDifference level(const Values& values) const;

  /// Of one moment.
  const std::vector<ScanCost>& costs(std::size_t moment) const { return costs_[moment]; }
  const BeamSectors& sectors(std::size_t moment) const { return sectors_[moment]; }

 private:
  const ScanSet* set_;
  const MomentWeights* weights_;
  std::vector<std::vector<ScanCost>> costs_;         ///< of each moment's scans
  std::vector<std::vector<BeamEvidence>> evidence_;  ///< the same
  std::vector<BeamSectors> sectors_;                 ///< of each moment
};

/// By how many standard errors a difference of the evidence stands out, with its sign.
/// \param map_error see HypothesisParams::mapError() [m]
POLYLOC_EXPORT double standardErrors(const PairedDifference& difference, double map_error);

}  // namespace mrpt_polyloc
