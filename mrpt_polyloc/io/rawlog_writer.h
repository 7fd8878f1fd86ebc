#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <string>
#include <vector>

namespace mrpt_polyloc {

/// Writes an MRPT rawlog (gzipped, observations only) of these scans, in this order; the same scans
/// give the same bytes. An existing file is overwritten.
/// \throws std::runtime_error naming the file if it cannot be written.
POLYLOC_EXPORT void writeScansRawlog(const std::string& path,
                                     const std::vector<mrpt::obs::CObservation2DRangeScan>& scans);

}  // namespace mrpt_polyloc
