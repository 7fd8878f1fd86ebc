#pragma once

#include "../common/Cli.h"
#include "../common/scan_sets.h"
#include "../common/search.h"
#include <mrpt_polyloc/evaluation/Summary.h>
#include <mrpt_polyloc/evaluation/summary_json.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// All that is to be known of one data set and one method: what the command line of one set says,
/// and each pair of a list.
struct EvaluationOptions {
  SearchOptions search;
  SetOptions sets;
  std::string truth, good;
  Tolerance tolerance;
};

/// Adds what addSearchOptions() adds, --truth, --good and --tolerance.
void addEvaluationOptions(CLI::App& cli, EvaluationOptions& options);

/// What is read before anything is searched.
struct EvaluationInputs {
  SetOptions sets;                         ///< what `drive` is for
  std::optional<DriveLog> drive;           ///< where a row may be more than one scan
  std::vector<RangeScan> scans;            ///< of a drive the first of each moment
  std::vector<mrpt::math::TPose2D> truth;  ///< of each scan
  std::optional<std::vector<std::size_t>> good;
};

/// Of a drive without odometry the movements are made from the truth. \throws FormatError
EvaluationInputs loadInputs(const Program& program, const EvaluationOptions& options);

/// The drive that inputs were taken from, for methods that need it where `drive` is empty.
/// \throws FormatError
DriveLog loadDriveOf(const Program& program, const EvaluationOptions& options,
                     const std::vector<mrpt::math::TPose2D>& truth);

/// A localized scan against its truth.
ScanRecord scoreLocalized(const LocalizedScan& scan, const mrpt::math::TPose2D& truth,
                          const Tolerance& tolerance);

}  // namespace mrpt_polyloc::apps
