#pragma once

#include <mrpt_polyloc/io/readings.h>
#include <mrpt_polyloc/io/scan_files.h>

namespace mrpt_polyloc {

/// The scans of a CARMEN log, plain or compressed, in file order: lines FLASER and ROBOTLASER1,
/// whose keyword is the sensor's label. If there are none, or if their label is asked for:
/// RAWLASER1 and 2, RLASER, ROBOTLASER2. Other lines are passed over.
///
/// FLASER says only the ranges, so where its beams look is told by, in this order:
/// `options.laser_fov`, spread over the beams and straight ahead in the middle;
/// `PARAM laser_front_laser_resolution` [deg]: straight ahead in the middle, but first beam at
/// -90 deg where that makes 180 deg up to one beam (180 beams of 1 deg reach from -90 to 89);
/// 180 or 181 beams: 1 deg, 360 or 361: 0.5 deg, first beam at -90 deg; one beam: straight ahead.
/// The laser is `PARAM robot_frontlaser_offset` [m] ahead of the robot's origin (0 if not given):
/// the two poses in the line tell nothing of it, for corrected logs change one or both. Its maximum
/// range is `PARAM robot_front_laser_max`, else `laser_front_max_range` [m]. RLASER is read alike,
/// `PARAM robot_rearlaser_offset` ahead (below 0: behind) and looking back.
/// Of a PARAM that occurs more than once the last line counts, for the whole log.
///
/// ROBOTLASER1 and 2 say their angles and their maximum range; the place on the robot is the
/// laser's pose seen from the robot's. RAWLASER1 and 2 say the same of their beams, and are placed
/// as FLASER and RLASER.
///
/// Readings are taken as readingToBeam() says; the maximum range that is not stated, or wrong, is
/// found from the whole log (see surveySensor()). A log that ends inside a line or its compressed
/// data is read up to there, with a note (`options.strict` refuses it). Stamps: the message's own
/// (ipc) time, or the logger's where that is 0. \throws FormatError naming file and line: a line
/// with too few or too many fields, something that is not a number, an FLASER line of another
/// number of beams without a field of view (the message names --laser-fov), a laser more than 5 m
/// from its robot (the log was changed); as selectSensor() for the labels; as GzInputStream for the
/// file itself. InvalidParamsError if `options.laser_fov` is not in (0, 2 pi].
std::vector<RangeScan> loadCarmen(const std::string& path, const ScanFileOptions& options = {},
                                  Notes* notes = nullptr);

/// The same before it is known what readings say, with the robot's pose by its wheels where the
/// lines hold one (FLASER and RLASER: the odometry pose; ROBOTLASER: the robot's pose). Several
/// labels may be asked for, see selectSensor().
std::vector<LoggedScan> loadLoggedCarmen(const std::string& path, const ScanFileOptions& options,
                                         Notes* notes);

}  // namespace mrpt_polyloc
