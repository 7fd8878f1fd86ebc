#pragma once

#include <mrpt_polyloc/localization/ranking/Calibration.h>
#include <mrpt_polyloc/localization/scan/PoseRefiner.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/CMatrixFixed.h>

#include <cstddef>

namespace mrpt_polyloc {

/// Covariance of the beam frame's pose (x, y, phi) [m, rad], from the curvature at the optimum,
/// with all beams of a sector (see BeamSectors) counted as one observation. Positive definite:
/// where the scan holds nothing, along a corridor, the pose is taken to be known to 0.5 m and 10
/// degrees, for a hypothesis is local.
mrpt::math::CMatrixDouble33 covarianceOfBeams(const RefinedPose& pose, std::size_t sectors);

/// That of the robot's pose, standard deviations corrected by the calibration's factors.
mrpt::math::CMatrixDouble33 covarianceOfRobot(const RefinedPose& pose, const RangeScan& scan,
                                              std::size_t sectors, const Calibration& calibration);

}  // namespace mrpt_polyloc
