#pragma once

#include "../common/search.h"
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// An SVG of the map and the last localized scan with its hypotheses; of the scans before it
/// the best poses as a path, and what they hit, faintly.
std::string scanPicture(const PolygonMap& map, const std::vector<RangeScan>& scans,
                        const std::vector<LocalizedScan>& localized);

}  // namespace mrpt_polyloc::apps
