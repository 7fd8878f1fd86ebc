#pragma once

#include "../common/search.h"

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// The results as CSV, one row a hypothesis; a scan without any has one row of rank 0 with an empty
/// pose. Metres and degrees; x, y and phi are the robot's.
/// \param with_maps one column more, the map of the hypothesis
std::string hypothesisCsv(const std::vector<LocalizedScan>& scans, bool with_maps = false);

}  // namespace mrpt_polyloc::apps
