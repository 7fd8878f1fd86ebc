#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// What a planner says to do.
enum class TravelStatus {
  go,       ///< drive to TravelPlan::waypoint, turn as it says, scan, plan again
  decided,  ///< there is one hypothesis, or none: nothing to tell apart
  /// No place within reach, as far as all hypotheses leave it safe, shows a difference between any
  /// two: driving on would be wandering.
  indistinguishable,
  blocked  ///< the robot touches something, or cannot leave its place
};

/// "go", "decided", "indistinguishable" or "blocked".
POLYLOC_EXPORT const char* toString(TravelStatus status);

/// Where to go next so that wrong hypotheses fall. All in the robot's frame of now.
struct POLYLOC_EXPORT TravelPlan {
  TravelStatus status = TravelStatus::decided;
  /// Where to stop and scan next, and how to turn there: the goal, or where the way to it leaves
  /// what is in sight now; or the robot's own place, where it is to turn first [m, rad].
  mrpt::math::TPose2D waypoint;
  std::vector<mrpt::math::TPoint2D> way;   ///< corners from the robot to the waypoint [m]
  mrpt::math::TPose2D goal;                ///< the place whose scan is to tell hypotheses apart
  std::vector<mrpt::math::TPoint2D> path;  ///< corners from the robot to the goal [m]
  double distance = 0.0;                   ///< length of the path [m]
  /// Expected share of the pairs of hypotheses, by weight, that the scan at the goal tells apart.
  double value = 0.0;
  /// For each hypothesis the weight of those that the scan at the goal tells from it: what speaks
  /// against it if one of those is right.
  std::vector<double> falls;
  std::size_t places = 0;    ///< candidates looked at
  double safe_area = 0.0;    ///< reached safely [m2]
  double planning_ms = 0.0;  ///< wall time
};

}  // namespace mrpt_polyloc
