#pragma once

#include <mrpt/math/TPose2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mrpt_polyloc::test {

/// A robot's way through the room of ProgramTest::roomFile(): its scans, and what its odometry
/// says.
struct Drive {
  std::vector<mrpt::math::TPose2D> truth;
  std::vector<mrpt::math::TPose2D> odometry;  ///< from a start of its own
  std::vector<mrpt::obs::CObservation2DRangeScan> scans;
};

/// Along the lower wall, a bend at a time. Scans of 120 beams over 240 degrees by brute force, with
/// 1 cm of noise, one each 0.1 s from 1e9 s on; odometry with 1 cm and 0.5 degrees a step.
Drive driveThroughRoom(std::size_t steps, std::uint32_t seed = 1);

/// Pairs of action and frame, the first action leading to the first frame; gzipped.
void writeActionLog(const std::string& path, const Drive& drive);
/// Odometry readings and scans in turn; gzipped.
void writeObservationLog(const std::string& path, const Drive& drive);

/// The truth in MRPT's format, the index being that of the pair.
std::string indexedTruth(const Drive& drive);
std::string tumTruth(const Drive& drive);

}  // namespace mrpt_polyloc::test
