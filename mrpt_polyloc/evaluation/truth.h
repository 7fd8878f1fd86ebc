#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mrpt_polyloc {

/// A pose of the robot's origin in the map at a time [s, m, rad].
struct POLYLOC_EXPORT StampedPose {
  double stamp = 0.0;
  mrpt::math::TPose2D pose_map_robot;
};

/// Reads a TUM trajectory, plain or compressed by gzip or zstd: `stamp x y z qx qy qz qw` a line,
/// `#` comments. The heading is the yaw of the quaternion. \throws FormatError naming file and
/// line: missing file, wrong number of fields, a number that is not finite, a quaternion that is
/// not of unit length (1e-2), no pose at all.
POLYLOC_EXPORT std::vector<StampedPose> loadTum(const std::string& path);

/// One TUM line per pose, stamps with nanoseconds, lengths with micrometres.
POLYLOC_EXPORT std::string toTum(const std::vector<StampedPose>& poses);

/// The true pose of each scan, matched by stamp within 1 ms. One pose may be the truth of several
/// scans (lasers that fire together).
/// \throws FormatError(path, ...) naming scan or line if a scan has no truth or two, or a truth no
/// scan.
POLYLOC_EXPORT std::vector<mrpt::math::TPose2D> matchTruth(const std::vector<RangeScan>& scans,
                                                           const std::vector<StampedPose>& truth,
                                                           const std::string& path);

/// Reads the ground truth of MRPT's data sets: `index x y phi` a line [m, rad], `#` comments, index
/// a whole number, which nothing may be said of twice. Whatever the file leaves out is null.
/// \param count of indices there can be
/// \throws FormatError naming file and line: missing file, wrong number of fields, a number that is
/// not finite, an index that is no whole number, not below `count` or there twice, no pose at all
POLYLOC_EXPORT std::vector<std::optional<mrpt::math::TPose2D>> loadIndexedTruth(
    const std::string& path, std::size_t count);

/// Whether the first line of a truth file that holds more than a comment has four fields, as
/// loadIndexedTruth() reads, rather than the eight of loadTum().
/// \throws FormatError naming the file if it cannot be read
POLYLOC_EXPORT bool isIndexedTruth(const std::string& path);

/// Reads row numbers (0-based), one a line, `#` comments: the good rows of a data set.
/// \throws FormatError naming file and line: not a number, out of [0, rows), a row twice.
POLYLOC_EXPORT std::vector<std::size_t> loadRows(const std::string& path, std::size_t rows);

}  // namespace mrpt_polyloc
