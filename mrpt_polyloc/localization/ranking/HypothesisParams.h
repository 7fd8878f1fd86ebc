#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/scan/BeamEvidenceParams.h>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT HypothesisParams {
  double merge_distance = 0.2;               ///< poses nearer than this are one hypothesis [m] ...
  double merge_angle = 0.06981317007977318;  ///< ... if their headings are, too [rad], 4 degrees
  /// A difference of the mean evidence counts in units of its standard error, or of this if that is
  /// less [m]: the map itself is not better.
  double indifference = 0.004;
  /// Whether hypotheses that stand in one long uncertain valley are returned as one, with a long
  /// covariance; only if SearchOptions::unite_valleys says so as well.
  bool unite_valleys = true;
  BeamEvidenceParams evidence;  ///< by which hypotheses are ranked and weighed
  Calibration calibration;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

}  // namespace mrpt_polyloc
