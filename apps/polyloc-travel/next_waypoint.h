#pragma once

#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/Motion.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <mrpt/math/TPose2D.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <vector>

namespace mrpt_polyloc::apps {

/// A scan of a real robot, and how its wheels say that it moved since the one before.
struct Look {
  mrpt::math::TPose2D moved{0, 0, 0};  ///< seen from where it was [m, rad]
  RangeScan scan{std::vector<Beam>{}};
};

struct NextWaypointParams {
  MotionNoise odometry;
  double most_distance = 100.0;  ///< it will not drive farther [m]
  std::uint64_t seed = 1;        ///< for the strategy random
  PosePrior prior;               ///< what is known of the pose of the first scan
};

/// Where a real robot is to drive next: its whole drive through DriveBelief, the last scan taken
/// now. What is returned is told in README.md under `--plan`.
/// \param looks at least one \throws InvalidParamsError
nlohmann::ordered_json nextWaypoint(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                                    const std::vector<Look>& looks,
                                    const NextWaypointParams& params);

}  // namespace mrpt_polyloc::apps
