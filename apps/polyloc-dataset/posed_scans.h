#pragma once

#include <mrpt_polyloc/base/notes.h>
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// A drive: scans and where the robot was, in the frame of the map that is to be.
struct PosedScans {
  std::vector<RangeScan> scans;
  std::vector<mrpt::math::TPose2D> poses;
};

/// The scans of a log with the poses of a TUM file (matched by stamp, see matchTruth()), or, with
/// no file named, of a corrected CARMEN log (the laser's pose in the line of each scan) or of an
/// MRPT simplemap (the mean poses of its keyframes). \param most_jump a longer step from one scan
/// to the next is refused [m] \throws FormatError naming file and place: as the loaders; a log that
/// is no CARMEN log and has no file of poses; poses that never move (not corrected, or none); a
/// jump
PosedScans loadPosedScans(const std::string& log, const std::string& poses,
                          const ScanFileOptions& options, double most_jump, Notes& notes);

}  // namespace mrpt_polyloc::apps
