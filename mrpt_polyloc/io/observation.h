#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/io/sensor_survey.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/obs/CObservation2DRangeScan.h>

namespace mrpt_polyloc {

/// Whether the beams run counterclockwise. MRPT fills its bool with whatever byte a file holds, and
/// to load any but 0 and 1 is undefined: any but 0 counts as true.
POLYLOC_EXPORT bool rightToLeft(const mrpt::obs::CObservation2DRangeScan& observation);

/// MRPT's observation as a RangeScan: bearings in the robot frame with the sensor's yaw and the
/// direction of the sweep (`rightToLeft`) taken in, the sensor's position as the beams' origin.
///
/// As in MRPT the aperture spans the beams from the first to the last, both included:
/// bearing_i = yaw -+ aperture (i / (N - 1) - 1/2); a single beam looks along the sensor's yaw.
/// A laser upside down (roll of 180 degrees) has mirrored bearings; one that is tilted is projected
/// to the floor, or refused, as SensorTilt says. Kinds are those of readingToBeam(), the maximum
/// range is `maxRange`: a live observation says its own. A stamp that is not set is 0.
/// \throws std::invalid_argument if the sensor's tilt is refused, if its pose or aperture is not
/// finite, or the aperture is negative.
POLYLOC_EXPORT RangeScan toRangeScan(const mrpt::obs::CObservation2DRangeScan& observation);

/// The same, before it is known what its readings say: for logs, which tell more than one scan.
/// \throws std::invalid_argument as toRangeScan(), but for the tilt
POLYLOC_EXPORT LoggedScan toLoggedScan(const mrpt::obs::CObservation2DRangeScan& observation);

/// Writes what is known of a sensor into an observation, so that all who take it understand it
/// alike: the maximum range, and hits that say nothing flagged not valid, with a range of 0.
POLYLOC_EXPORT void applyFacts(const SensorFacts& facts,
                               mrpt::obs::CObservation2DRangeScan& observation);

/// A scan as MRPT's observation, swept right to left; the inverse of toRangeScan() up to the single
/// precision of MRPT's ranges and hits at or above kNoReturnShare of the maximum range, which come
/// back as no-returns. A RangeScan does not keep the bearings of its invalid beams, hence the
/// sensor's shape is given.
///
/// \param scan whose beams are spread evenly over `aperture`, both ends included, in rising order
/// \param aperture field of view [rad]
/// \param yaw of the sensor on the robot, the bearing of its middle [rad]
/// \param max_range of the sensor [m]; what lies at or beyond it is stored as no-return
/// \throws std::invalid_argument if a beam is elsewhere (1e-6 rad), or an argument out of range.
POLYLOC_EXPORT mrpt::obs::CObservation2DRangeScan toObservation(const RangeScan& scan,
                                                                double aperture, double yaw,
                                                                double max_range);

/// The same of a scan whose beams may be spread anyhow: the aperture is from its first to its last
/// beam that says something, the spacing the middle one of its own spacings (1 degree for a single
/// beam), and beams that are elsewhere move by up to half of it. Of several on one place the last
/// hit stays. Where no beam was, nothing is known.
/// \throws std::invalid_argument for a maximum range that is not positive and finite
POLYLOC_EXPORT mrpt::obs::CObservation2DRangeScan toEvenObservation(const RangeScan& scan,
                                                                    double max_range);

}  // namespace mrpt_polyloc
