#pragma once

#include "TravelRun.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc::apps {

/// Whether a run was right to say `indistinguishable`: the truth is among the hypotheses left, and
/// there is another of which, wherever the robot can get in the true map, brute force
/// (WallSegments) reads the same but for a few beams. Places 0.5 m apart, at most 1,500.
bool isTrulyIndistinguishable(const TravelPlanner& planner, const World& world,
                              const TravelRunResult& run, double most_distance);

/// The shortest tour [m] from the start of a run that tells the truth from all hypotheses that the
/// first scan left, by someone who knows the truth: over places 0.5 m apart in the true map, with
/// the planner's measure of what tells. None where there are more than 6 rivals or 1,500 places, or
/// if some rival cannot be told apart.
std::optional<double> shortestTour(const TravelPlanner& planner, const World& world,
                                   const TravelRunResult& run);

}  // namespace mrpt_polyloc::apps
