#include "next_waypoint.h"

#include "plan_json.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;
using nlohmann::ordered_json;

}  // namespace

ordered_json nextWaypoint(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                          const std::vector<Look>& looks, const NextWaypointParams& params) {
  HypothesisTracker tracker(localizer, {}, params.prior);
  std::vector<TPose2D> odometry;
  TPose2D at(0, 0, 0);
  for (const Look& look : looks) {
    if (!odometry.empty()) {
      tracker.move(measuredMotion(look.moved, params.odometry));
      at = at + look.moved;
    }
    tracker.update(look.scan);
    odometry.push_back(at);
  }

  const TrackingState& state = tracker.state();
  TravelSituation situation;
  ordered_json hypotheses = ordered_json::array();
  for (const TrackedHypothesis& tracked : state.hypotheses) {
    situation.hypotheses.push_back(tracked.toHypothesis());
    const TPose2D& pose = tracked.pose_map_robot;
    hypotheses.push_back(
        {{"x", pose.x}, {"y", pose.y}, {"phi", pose.phi}, {"weight", tracked.weight}});
  }
  constexpr std::size_t kKept = 3;  // scans that say what stands beside the robot
  for (std::size_t i = looks.size(); i-- > 0;) {
    const TPose2D seen = odometry[i] - odometry.back();
    situation.looked.push_back(seen);
    if (situation.scans.size() < kKept) situation.scans.push_back({looks[i].scan, seen});
  }
  situation.most_distance = params.most_distance;
  situation.seed = params.seed;

  const bool is_known = state.status == LocalizationStatus::unique;
  TravelPlan plan;
  if (!is_known) {
    plan = state.status == LocalizationStatus::ambiguous ? planner.plan(situation)
                                                         : planner.explore(situation);
    if (plan.status == TravelStatus::decided) plan = planner.explore(situation);
  }
  ordered_json json = toJson(plan);
  if (is_known) json["status"] = "unique";
  json["localization"] = toString(state.status);
  json["none_probability"] = state.none_probability;
  json["hypotheses"] = std::move(hypotheses);
  return json;
}

}  // namespace mrpt_polyloc::apps
