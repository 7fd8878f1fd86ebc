#pragma once

#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPoint2D.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// Reads the polygons that a robot at the origin sees without any noise: WKT, one POLYGON without
/// holes a line, in metres and the robot's frame, either orientation. Lines that are blank do not
/// count. Row i is given the stamp i seconds, by which a truth file names it.
///
/// Each is handed on as a scan with a beam for each vertex, in order, so that the programs treat
/// it as any other. \throws FormatError naming file and line
std::vector<RangeScan> loadViewPolygons(const std::string& path);

/// The polygon of such a scan, counterclockwise.
std::vector<mrpt::math::TPoint2D> viewPolygon(const RangeScan& scan);

}  // namespace mrpt_polyloc::apps
