#pragma once

#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// The section `_likelihoodOpts` of a CPolygonMap2D. Names in an ini are those of the fields.
struct TLikelihoodOptions : public mrpt::config::CLoadableOptions {
  /// "robust": RobustCost, for maps that are not complete; "polar": squared differences of ranges
  /// over the hits, as the polar coordinate metric has them, truncated at tau_long.
  std::string metric = "robust";
  /// Scale of a difference [m]: of a Laplace density (robust) or a Gaussian one (polar). What a map
  /// and a laser are off by in a furnished building.
  double sigma = 0.1;
  /// Every n-th beam is compared. 1: prediction is cheap, so none need be left out.
  unsigned decimation = 1;
  /// A scan counts as at most so many independent beams: neighbours see the same wall, and counting
  /// each of 361 would let one particle take all the weight. Tuned on three data sets, see
  /// doc/mrpt.md: fewer suit filters that start anywhere, more gain no accuracy.
  double independent_beams = 20.0;
  RobustCostParams cost;  ///< tau_short, tau_long, tau_open, tau_none [m], none_share

  /// \throws InvalidParamsError for an unknown name or a value out of range
  void loadFromConfigFile(const mrpt::config::CConfigFileBase& source,
                          const std::string& section) override;
  void dumpToTextStream(std::ostream& out) const override;
  /// \throws InvalidParamsError naming the bad field
  void check() const;
};

/// No scan's log-likelihood is below this: MRPT's filters refuse what is not finite.
constexpr double kLogLikelihoodFloor = -1e9;

/// Log-likelihood (not normalised, at most 0) of a scan from a pose of the ROBOT; 0 if no beam says
/// anything. A pose away from free space costs as much as a scan can. What the scan gives is
/// prepared once per thread and kept while the contents of the scan, not its address, are the same.
/// \throws std::invalid_argument as toRangeScan()
double scanLogLikelihood(const RangePredictor& predictor,
                         const mrpt::obs::CObservation2DRangeScan& scan,
                         const mrpt::math::TPose2D& pose_map_robot,
                         const TLikelihoodOptions& options);

/// The same for many poses of the ROBOT, in their order; taken cell by cell, so that what is seen
/// from a cell stays in the processor's cache.
std::vector<double> scanLogLikelihoods(const RangePredictor& predictor,
                                       const mrpt::obs::CObservation2DRangeScan& scan,
                                       const std::vector<mrpt::math::TPose2D>& poses_map_robot,
                                       const TLikelihoodOptions& options);

}  // namespace mrpt_polyloc
