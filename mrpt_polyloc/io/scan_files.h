#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/io/readings.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT ScanFileOptions {
  /// Only scans of the sensor with this label; empty: all, if the file holds one label only.
  std::string sensor_label;
  /// Field of view of CARMEN FLASER scans, from the first beam to the last [rad]; it wins over what
  /// the log says. See loadCarmen().
  std::optional<double> laser_fov;
  /// What readings mean, where the log does not say or is wrong.
  ReadingOptions readings;
  /// Refuse a file that ends too early, instead of reading what is whole of it: robots lose power.
  bool strict = false;
  /// A log of more scans is refused.
  std::size_t max_scans = 10'000'000;
};

/// All laser scans of a log, in file order: .rawlog (action/sensory-frame or observations only),
/// CARMEN .log/.clf, each plain or compressed by gzip or zstd.
/// \param notes gets a sentence for all that was assumed or is missing; may be null
/// \throws FormatError naming file and place (object, line or byte) for a missing, empty, damaged
/// or foreign file, one that is cut short (if `options.strict`, or if no scan of it is whole), an
/// unknown extension, more scans than `options.max_scans`, a scan of more than 100,000 beams,
/// several sensor labels where none is chosen, a label that does not occur, a sensor that is tilted
/// too much (see SensorTilt), a log without scans. InvalidParamsError for an option out of range.
POLYLOC_EXPORT std::vector<RangeScan> loadScans(const std::string& path,
                                                const ScanFileOptions& options = {},
                                                Notes* notes = nullptr);

}  // namespace mrpt_polyloc
