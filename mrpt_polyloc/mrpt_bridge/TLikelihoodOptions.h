#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>

#include <mrpt/config/CLoadableOptions.h>

#include <iosfwd>
#include <string>

namespace mrpt_polyloc {

/// The section `_likelihoodOpts` of a CPolygonMap2D. Names in an ini are those of the fields.
struct POLYLOC_EXPORT TLikelihoodOptions : public mrpt::config::CLoadableOptions {
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

}  // namespace mrpt_polyloc
