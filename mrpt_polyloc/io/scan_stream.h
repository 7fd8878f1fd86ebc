#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/io/readings.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Given the scans of a log one by one, in file order.
using TakeLoggedScan = std::function<void(LoggedScan)>;

/// What is known of a log when it has been read.
struct POLYLOC_EXPORT ScanStreamEnd {
  /// The scans of the sensor that was asked for, by their number as they were given.
  std::vector<std::size_t> rows;
  /// Completes such a scan by what the log as a whole says; may be null.
  std::function<void(std::size_t number, LoggedScan& scan)> finish;
};

/// Reads a rawlog as loadRawlog() does, keeping none of its scans. Those of another sensor than the
/// one asked for are given without content.
POLYLOC_EXPORT ScanStreamEnd streamRawlog(const std::string& path, const ScanFileOptions& options,
                                          Notes* notes, const TakeLoggedScan& take);

/// The same of a CARMEN log, as loadCarmen().
POLYLOC_EXPORT ScanStreamEnd streamCarmen(const std::string& path, const ScanFileOptions& options,
                                          Notes* notes, const TakeLoggedScan& take);

}  // namespace mrpt_polyloc
