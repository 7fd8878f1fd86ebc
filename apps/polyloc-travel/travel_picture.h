#pragma once

#include "TravelRun.h"

#include <string>

namespace mrpt_polyloc::apps {

/// A run as SVG: the map, the safe set of the first step where the robot truly was, the robot's way
/// with its stops, and for each hypothesis the way that it would have gone, up to where it fell.
std::string travelPicture(const TravelPlanner& planner, const World& world,
                          const TravelRunResult& run);

}  // namespace mrpt_polyloc::apps
