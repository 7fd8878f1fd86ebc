#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Writes an MRPT rawlog (gzipped, observations only) of these scans, in this order; the same scans
/// give the same bytes. An existing file is overwritten.
/// \throws std::runtime_error naming the file if it cannot be written.
POLYLOC_EXPORT void writeScansRawlog(const std::string& path,
                                     const std::vector<mrpt::obs::CObservation2DRangeScan>& scans);

/// What a robot did and saw at one moment.
struct POLYLOC_EXPORT RawlogMoment {
  mrpt::math::TPose2D movement{0, 0, 0};  ///< since the moment before, by its wheels [m, rad]
  std::vector<mrpt::obs::CObservation2DRangeScan> scans;
};

/// Writes an MRPT rawlog of pairs of action and sensory frame, as MRPT's filters read it. \param
/// noise what the actions say of the wheels, as MRPT's Gaussian motion model
/// \throws as writeScansRawlog()
POLYLOC_EXPORT void writeDriveRawlog(const std::string& path,
                                     const std::vector<RawlogMoment>& moments,
                                     const MotionNoise& noise);

}  // namespace mrpt_polyloc
