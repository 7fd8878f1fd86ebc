#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/localization/scan/ScanSet.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What a log holds moment by moment: the scans of one laser or of several, and how the robot came
/// from one moment to the next.
struct POLYLOC_EXPORT DriveLog {
  std::vector<Moment> moments;  ///< at least one
  /// Whether wheels say how the robot moved; without, every moment is after a gap.
  bool has_odometry = false;
};

/// The moments of a log, in file order: .rawlog or CARMEN .log/.clf, see loadScans().
///
/// Scans of one sensory frame are of one moment; else scans one after the other, of different
/// sensors, with stamps within kOneMoment. The order of a moment's scans is that of the file; a
/// sensor that is missing in some of the moments is missing there, with a note.
///
/// Movements: in logs of actions and sensory frames those of the actions; in logs of observations
/// what the CObservationOdometry readings say, between two readings in proportion to the time (the
/// last one before the scan if there are no stamps); in CARMEN logs the poses by wheels in the
/// lines. Where no reading is known yet, a moment is after a gap.
/// \param options `sensor_label` may be a list with commas, or "all"
/// \param noise of the wheels, which logs rarely tell
/// \throws FormatError as loadScans(), also for a movement that is not finite
POLYLOC_EXPORT DriveLog loadDrive(const std::string& path, const ScanFileOptions& options = {},
                                  const MotionNoise& noise = {}, Notes* notes = nullptr);

}  // namespace mrpt_polyloc
