#pragma once

#include <mrpt_polyloc/localization/RangeScan.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

namespace mrpt_polyloc {

/// MRPT's observation as a RangeScan: bearings in the robot frame with the sensor's yaw and the
/// direction of the sweep (`rightToLeft`) taken in, the sensor's position as the beams' origin.
///
/// Kinds: flagged valid = hit; not valid with a finite range > 0 = no-return; a range that is 0,
/// negative, NaN or infinite = invalid; a hit at or above `maxRange` is a no-return.
/// \throws std::invalid_argument if the sensor's pitch or roll is not zero (1 mrad), or its pose or
/// aperture is not finite.
RangeScan toRangeScan(const mrpt::obs::CObservation2DRangeScan& observation);

}  // namespace mrpt_polyloc
