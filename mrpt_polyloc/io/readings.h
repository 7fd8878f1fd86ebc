#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>

namespace mrpt_polyloc {

/// What a laser's reading says, in one way for all kinds of logs.
///
/// 0, negative, NaN or infinite: invalid. Else flagged valid and below `max_range`: a hit. Else
/// (not valid, or at or above `max_range`): a no-return of range `max_range`.
/// \param bearing in the robot frame [rad]
/// \param max_range of the sensor [m]; where it is not positive and finite nothing is beyond it,
/// and a no-return has the reading for its range
Beam readingToBeam(double bearing, double range, bool valid, double max_range);

}  // namespace mrpt_polyloc
