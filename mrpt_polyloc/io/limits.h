#pragma once

#include <mrpt_polyloc/base/errors.h>

#include <cstddef>
#include <string>

namespace mrpt_polyloc {

// What files may ask for at most; a file beyond it is taken for damaged or hostile. SECURITY.md
// lists these limits and kMaxBitmapCells.

/// Beams of a scan.
constexpr std::size_t kMaxBeams = 100'000;

/// Poses of a simplemap.
constexpr std::size_t kMaxMapPoses = 1'000'000;

/// Poses that MRPT draws from a movement by odometry when it reads it: 300 mostly.
constexpr std::size_t kMaxDrawnPoses = 100'000;

/// Content of a file that is read at once (polygons, yaml, images, calibrations), decompressed
/// [bytes]. Logs are read piece by piece.
constexpr std::size_t kMaxWholeFile = std::size_t{1} << 30U;

/// \throws FormatError if a log has more scans than it may
inline void requireScans(const std::string& path, const std::string& place, std::size_t scans,
                         std::size_t most) {
  if (scans <= most) return;
  throw FormatError(path, place,
                    "more than " + std::to_string(most) + " scans: cut the log to pieces");
}

}  // namespace mrpt_polyloc
