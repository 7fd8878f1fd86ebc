#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/io/scan_files.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// What a particle filter is given at once: how the robot moved, and what it saw then.
struct POLYLOC_EXPORT ReplayStep {
  std::size_t object = 0;  ///< number of the object of the file that holds the scan
  /// Number of the pair of action and frame as MRPT counts them, none for a frame without an action
  /// before it; in logs of observations the number of the step.
  std::optional<std::size_t> pair;
  /// The movement since the step before; null in the first step, for there is none before it.
  mrpt::obs::CActionCollection::Ptr action;
  mrpt::obs::CSensoryFrame::Ptr frame;            ///< all that is weighed
  mrpt::obs::CObservation2DRangeScan::Ptr laser;  ///< the scan in it that is searched for
  RangeScan scan{std::vector<Beam>{}};            ///< the same scan
  /// Of all sensors that were asked for in the frame, in its order; the first is `scan`.
  std::vector<RangeScan> scans;
};

/// The noise of movements: of odometry readings, which logs of observations do not state.
struct POLYLOC_EXPORT OdometryNoise {
  double min_std_xy = 0.04;                   ///< [m] as pf-localization's default
  double min_std_phi = 0.034906585039886592;  ///< [rad] 2 degrees, as pf-localization's default
  /// Actions get this noise, too, instead of the one recorded with them: for odometry that is late
  /// or worse than its log says.
  bool replaces_recorded = false;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The steps of an MRPT rawlog, in file order, one for each frame or observation that holds a scan
/// of the sensor.
///
/// Actions and sensory frames: the frame as it is recorded; the movements of several actions since
/// the last frame with a scan are composed, with the noise model of the last. Frames without a scan
/// are passed over. Observations only: the frame is the scan alone; the movement is what the
/// CObservationOdometry readings before it say, standing still where there are none.
///
/// What the log as a whole tells of its sensor (see surveySensor()) is written into the scans, too,
/// so that the filter's map and the search take them alike.
/// \param options, notes as in loadRawlog()
/// \throws FormatError as loadRawlog(), and for an action that does not say how the robot moved in
/// the plane
POLYLOC_EXPORT std::vector<ReplayStep> loadReplayLog(const std::string& path,
                                                     const ScanFileOptions& options = {},
                                                     const OdometryNoise& noise = {},
                                                     Notes* notes = nullptr);

}  // namespace mrpt_polyloc
