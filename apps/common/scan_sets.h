#pragma once

#include "Cli.h"
#include "search.h"
#include <mrpt_polyloc/io/drive_log.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Which scans of a log make one query.
struct SetOptions {
  double accumulate = 0.0;  ///< those of the last so many metres of the wheels' way, too [m]
  MotionNoise noise;        ///< of the wheels
  /// Of these at most so many moments, and none from before a longer step [m]: LastMetresParams.
  std::size_t most_moments = LastMetresParams().most_moments;
  double longest_step = LastMetresParams().longest_step;

  /// Whether a row may be more than one scan.
  bool areAsked(const ScanFileOptions& file) const;
};

/// Adds --sensor and --accumulate.
void addSetOptions(CLI::App& cli, SetOptions& sets, ScanFileOptions& file);

/// The moments of a log, with notes on what was assumed.
/// \throws UsageError unless the search's method takes scan sets (certified does)
DriveLog loadSearchedDrive(const Program& program, const SearchOptions& search,
                           const SetOptions& sets);

/// The first scan of each moment: what a row is known by.
std::vector<RangeScan> firstScans(const DriveLog& drive);

/// localizeScans() for moments, each with what was seen on the last metres before it. \param
/// on_done as there \throws FormatError naming the log if it holds no movements and some are asked
/// for
std::vector<LocalizedScan> localizeDrive(
    const ScanLocalizer& localizer, const DriveLog& drive, const SetOptions& sets,
    const std::vector<std::size_t>& rows, const PosePrior& prior, const SearchOptions& search,
    const std::function<void(const LocalizedScan&)>& on_done = {});

/// The same over several maps. \param names of the maps, for LocalizedScan::maps
std::vector<LocalizedScan> localizeDrive(const MultiMapSearch& localize,
                                         const std::vector<std::string>& names,
                                         const DriveLog& drive, const SetOptions& sets,
                                         const std::vector<std::size_t>& rows,
                                         const PosePrior& prior, const SearchOptions& search);

}  // namespace mrpt_polyloc::apps
