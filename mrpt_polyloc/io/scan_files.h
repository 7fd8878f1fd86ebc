#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

struct ScanFileOptions {
  /// Only scans of the sensor with this label; empty: all, if the file holds one label only.
  std::string sensor_label;
  /// Field of view of CARMEN FLASER scans, from the first beam to the last [rad]; it wins over what
  /// the log says. See loadCarmen().
  std::optional<double> laser_fov;
};

/// All laser scans of a log, in file order: .rawlog (action/sensory-frame or observations only),
/// CARMEN .log/.clf, each plain or gzipped.
/// \throws FormatError naming file and place (object, line or byte) for a missing, empty, truncated
/// or foreign file, an unknown extension, several sensor labels where none is chosen, a label that
/// does not occur, a sensor that is not planar, a log without scans. InvalidParamsError for a field
/// of view out of range.
std::vector<RangeScan> loadScans(const std::string& path, const ScanFileOptions& options = {});

}  // namespace mrpt_polyloc
