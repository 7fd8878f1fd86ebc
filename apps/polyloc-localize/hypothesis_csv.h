#pragma once

#include "../common/search.h"

#include <string>
#include <vector>

namespace mrpt_polyloc::apps {

/// The results as CSV, one row a hypothesis; a scan without any has one row of rank 0 with an empty
/// pose. Metres and degrees; x, y and phi are the robot's.
std::string hypothesisCsv(const std::vector<LocalizedScan>& scans);

}  // namespace mrpt_polyloc::apps
