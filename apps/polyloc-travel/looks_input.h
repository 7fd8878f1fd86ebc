#pragma once

#include "../common/Cli.h"
#include "TravelOptions.h"
#include "next_waypoint.h"

#include <vector>

namespace mrpt_polyloc::apps {

/// All scans of a log with the movements between them, if it says how the robot moved, else the
/// last scan alone. \throws FormatError
std::vector<Look> loadLooks(const Program& program, const TravelOptions& options);

}  // namespace mrpt_polyloc::apps
