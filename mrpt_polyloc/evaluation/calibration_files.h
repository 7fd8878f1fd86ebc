#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/evaluation/CalibrationFit.h>
#include <mrpt_polyloc/localization/ranking/Calibration.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A calibration as JSON: an object with its fields by name, `match_weights` an object by feature.
POLYLOC_EXPORT nlohmann::ordered_json calibrationJson(const Calibration& calibration);

/// Reads what calibrationJson() writes; members that it does not know are ignored.
/// \throws FormatError naming file and member: missing file, no JSON, a member that is missing, no
/// number or out of range
POLYLOC_EXPORT Calibration loadCalibration(const std::string& path);

/// The text of default_calibration.h. \param origin what it was made from and how, put into its
/// comment; one line each
POLYLOC_EXPORT std::string calibrationHeader(const Calibration& calibration,
                                             const std::vector<std::string>& origin);

/// The figures of an outcome as JSON: counts, shares, area under the ROC curve, foreign scans
/// refused at 1, 3 and 5 % of the true lost, the reliability diagram, mean squared errors.
POLYLOC_EXPORT nlohmann::ordered_json outcomeJson(const CalibrationOutcome& outcome);

}  // namespace mrpt_polyloc
