#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/travel/SafeSet.h>

#include <vector>

namespace mrpt_polyloc::apps {

/// The border of the squares that are reached, for pictures: closed rings in the robot's frame,
/// filled by the even-odd rule [m]. None if nothing is reached. \param square side of them [m]
std::vector<Polyline> safeSetOutline(const SafeSet& safe, double square);

}  // namespace mrpt_polyloc::apps
