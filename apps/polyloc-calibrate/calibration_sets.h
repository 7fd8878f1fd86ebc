#pragma once

#include "../common/Cli.h"
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Scans of one building with their truth: a line of the list of sets, loaded but for its map.
struct CalibrationSet {
  std::string name;
  std::size_t building = 0;  ///< number of the first set of the same building
  /// Whether it is one more form of a building (its name has a slash): an example of what weights
  /// and `unique` are worth, not of what a match is.
  bool is_form = false;
  std::string map;  ///< path
  std::vector<RangeScan> scans;
  std::vector<mrpt::math::TPose2D> truth;  ///< of each scan
  std::vector<bool> good;                  ///< of each scan: whether it agrees with the map
};

/// Reads a list: `NAME MAP SCANS TRUTH [GOOD]` a line, `#` comments, paths from the list's folder
/// on, without blanks. Names alike up to a slash, as intel and intel/0.1, are of one building.
/// Without GOOD all rows are good. Prints notes on what was assumed of scans. \param file how all
/// scans are read \throws FormatError naming file and line, or the file of a set: fewer than two
/// sets, a name twice, fewer than two buildings, a file that is not there or not readable
std::vector<CalibrationSet> loadCalibrationSets(const Program& program, const std::string& path,
                                                const ScanFileOptions& file);

}  // namespace mrpt_polyloc::apps
