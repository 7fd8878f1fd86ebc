#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// Where a scan comes from, seen from the map it was localized in.
enum class ScanOrigin { own, cluttered, foreign };

/// What a calibration needs of one localized scan.
struct POLYLOC_EXPORT CalibrationSample {
  std::size_t map = 0;  ///< which map it was localized in
  std::size_t set = 0;  ///< which set it comes from; its map's unless foreign
  ScanOrigin origin = ScanOrigin::own;
  bool good = false;  ///< whether the scan agrees with its own map
  MatchFeatures features;
  struct Candidate {
    double z_score = 0.0;  ///< Hypothesis::z_score
    bool right = false;    ///< within the tolerance of the truth
  };
  std::vector<Candidate> candidates;  ///< in their order, at least one
  /// Of right first answers: squares of the errors by the stated covariance: of the position (two
  /// degrees of freedom) and the heading (one).
  std::optional<double> position_square, heading_square;
};

/// The calibration to localize with when samples are gathered: nothing is refused, and covariances
/// are as the refinement gives them.
POLYLOC_EXPORT Calibration uncalibrated();

/// The sample of a result that was found with uncalibrated(); none if nothing was found.
/// \param truth where the scan was taken; null for a foreign one. map, set, origin and good are
/// left to the caller.
POLYLOC_EXPORT std::optional<CalibrationSample> calibrationSample(const LocalizationResult& result,
                                                                  const mrpt::math::TPose2D* truth,
                                                                  const Tolerance& tolerance = {});

}  // namespace mrpt_polyloc
