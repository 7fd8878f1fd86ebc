#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/calibration_samples.h>
#include <mrpt_polyloc/evaluation/reliability.h>
#include <mrpt_polyloc/evaluation/roc.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT CalibrationFitParams {
  /// Share of the good own scans that may be refused. Few: a scan that is refused is lost even
  /// where its answer would have been right.
  double lost = 0.005;
  /// Share of the answers called `unique` that must be right.
  double unique_right = 0.995;
  /// Share of the scans of other buildings that may be called `unique`.
  double foreign_unique = 0.003;
  /// A cluttered scan counts as so many own ones: they shall not decide what a usual scan is.
  double clutter_weight = 0.1;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Fits a calibration:
///  - the match score by logistic regression of good own (and, with less weight, cluttered) against
///    foreign scans, both classes weighing the same; its threshold from `lost`;
///  - the decay of the weights by the likelihood of the right hypotheses of own scans;
///  - the threshold of `unique`, the least one from which on the own scans meet `unique_right` and
///    the foreign ones `foreign_unique`;
///  - the factors of the covariance, such that the squared errors of right answers are on average
///    as stated.
/// \throws InvalidParamsError if there is no good own scan, no foreign one, or no own scan with a
/// right answer
POLYLOC_EXPORT Calibration fitCalibration(const std::vector<CalibrationSample>& samples,
                                          const CalibrationFitParams& params = {});

/// What calibrations do on samples.
struct POLYLOC_EXPORT CalibrationOutcome {
  std::vector<RocPoint> roc;            ///< by match probability: good own against foreign scans
  std::size_t good = 0, good_lost = 0;  ///< own scans that agree with the map; refused
  std::size_t cluttered = 0, cluttered_lost = 0;  ///< the same with clutter
  std::size_t foreign = 0, foreign_refused = 0;
  std::size_t foreign_unique = 0;            ///< the worst error: another building, called unique
  std::size_t unique = 0, unique_right = 0;  ///< own scans, all of them
  std::vector<ReliabilityBin> reliability;   ///< first weights of own scans that are not refused
  double position_square = 0.0, heading_square = 0.0;  ///< means; consistent: 2 and 1
};

/// \param calibrations one for each sample: the same, or that of its fold
/// \throws InvalidParamsError if there is no good own or no foreign scan
POLYLOC_EXPORT CalibrationOutcome judge(const std::vector<CalibrationSample>& samples,
                                        const std::vector<Calibration>& calibrations);

/// For each sample the calibration fitted without its map: without scans localized in that map and
/// without scans taken in it. None if that leaves nothing to fit (there must be three sets).
POLYLOC_EXPORT std::optional<std::vector<Calibration>> leaveOneMapOut(
    const std::vector<CalibrationSample>& samples, const CalibrationFitParams& params = {});

}  // namespace mrpt_polyloc
