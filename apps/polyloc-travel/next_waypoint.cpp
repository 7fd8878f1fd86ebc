#include "next_waypoint.h"

#include "DriveBelief.h"
#include "plan_json.h"

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
  DriveBelief belief(localizer, params.odometry, params.prior);
  std::vector<TPose2D> odometry;
  TPose2D at(0, 0, 0);
  for (const Look& look : looks) {
    if (!odometry.empty()) {
      belief.move(measuredMotion(look.moved, params.odometry), std::abs(look.moved.phi));
      at = at + look.moved;
    }
    belief.look(look.scan);
    odometry.push_back(at);
  }

  const TrackingState& state = belief.state();
  TravelSituation situation;
  ordered_json hypotheses = ordered_json::array();
  for (const TrackedHypothesis& tracked : state.hypotheses) {
    if (belief.isKnowing()) situation.hypotheses.push_back(tracked.toHypothesis());
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

  const bool is_known = belief.answer().has_value();
  TravelPlan plan;
  if (!is_known) {
    plan = belief.isKnowing() ? planner.plan(situation) : planner.explore(situation);
    if (plan.status == TravelStatus::decided) plan = planner.explore(situation);
  }
  ordered_json json = toJson(plan);
  if (is_known) json["status"] = "unique";
  // As sure as the tracker may be, the last metres have not said so.
  const LocalizationStatus tracked =
      state.status == LocalizationStatus::unique ? LocalizationStatus::ambiguous : state.status;
  json["localization"] = toString(is_known ? LocalizationStatus::unique : tracked);
  json["none_probability"] = state.none_probability;
  json["hypotheses"] = std::move(hypotheses);
  return json;
}

}  // namespace mrpt_polyloc::apps
