#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>

#include <string>

namespace mrpt_polyloc::apps {

/// What is seen of free space from a point of it, as WKT: the visibility polygon relative to the
/// point, counterclockwise. Sight ends at walls and open edges alike.
/// \throws InvalidParamsError for a point outside free space
std::string viewText(const PolygonMap& map, const TPoint2D& viewpoint);

}  // namespace mrpt_polyloc::apps
