#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/Motion.h>

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What wheels would have measured between poses of a robot that follow one another: each movement
/// with normal errors of its own, of the standard deviations that the noise gives it. The first
/// movement is none. The same seed gives the same errors.
/// \param noise of the wheels, which is also what the movements say of themselves
POLYLOC_EXPORT std::vector<Motion> simulatedOdometry(
    const std::vector<mrpt::math::TPose2D>& poses_map_robot, const MotionNoise& noise,
    std::uint64_t seed);

}  // namespace mrpt_polyloc
