#pragma once

#include "../common/Cli.h"
#include "TravelOptions.h"

#include <nlohmann/json.hpp>

namespace mrpt_polyloc::apps {

/// Where a real robot is to drive next, from the scans of its log: the whole drive through
/// HypothesisTracker if the log says how the robot moved, else the last scan alone.
/// \throws FormatError, InvalidMapError
nlohmann::ordered_json nextWaypoint(const Program& program, const TravelOptions& options);

}  // namespace mrpt_polyloc::apps
