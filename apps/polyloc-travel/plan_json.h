#pragma once

#include <mrpt_polyloc/travel/TravelPlan.h>

#include <nlohmann/json_fwd.hpp>

namespace mrpt_polyloc::apps {

/// {status, waypoint, way, goal, distance, value, falls: [{hypothesis, by}], safe_area,
/// planning_ms}, as README.md tells it; all in the robot's frame [m, rad]. Waypoint, goal and
/// distance are null unless the plan is to go.
nlohmann::ordered_json toJson(const TravelPlan& plan);

}  // namespace mrpt_polyloc::apps
