#include "Drive.h"

#include "../polyloc-travel/plan_json.h"
#include "../polyloc-travel/safe_set_outline.h"
#include "ApiError.h"
#include "endpoint_json.h"
#include "endpoints.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/result_json.h>
#include <mrpt_polyloc/io/scan_json.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// Whether a pose is one that is still believed in, as far as wheels can tell.
bool isAmong(const TPose2D& pose, const std::vector<TrackedHypothesis>& living) {
  constexpr double kFar = 0.5, kTurned = 10.0 * kDegree;
  return std::any_of(living.begin(), living.end(), [&](const TrackedHypothesis& hypothesis) {
    const TPose2D& other = hypothesis.pose_map_robot;
    return std::hypot(pose.x - other.x, pose.y - other.y) < kFar &&
           angleBetween(pose.phi, other.phi) < kTurned;
  });
}

}  // namespace

Drive::Drive(std::shared_ptr<const TravelPlanner> planner, const GlobalLocalizer& localizer,
             World world, const TPose2D& start, const TravelRunParams& params, std::uint64_t seed)
    : planner_(std::move(planner)),
      localizer_(localizer),
      world_(std::move(world)),
      run_(*planner_, localizer_, world_, start, params, seed) {}

Drive::Json Drive::step(std::size_t number, const std::atomic<bool>& cancelled) {
  const std::lock_guard<std::mutex> lock(mutex_);
  while (steps_.size() <= number && !run_.isOver()) {
    if (cancelled) throw superseded();
    const Stopwatch watch;
    run_.drive();
    run_.look();
    const double ms = 1e3 * watch.seconds();
    findFallen();
    steps_.push_back(told(ms));
  }
  return steps_[std::min(number, steps_.size() - 1)];
}

void Drive::findFallen() {
  const std::vector<TravelStep>& made = run_.result().steps;
  const TPose2D moved = run_.odometry() - odometry_before_;
  odometry_before_ = run_.odometry();
  if (made.size() < 2) return;
  for (const TrackedHypothesis& before : made[made.size() - 2].hypotheses) {
    const TPose2D now = before.pose_map_robot + moved;
    if (!isAmong(now, made.back().hypotheses)) {
      fallen_.push_back({now, before.weight, made.size() - 1});
    }
  }
}

Drive::Json Drive::resultJson(double ms) const {
  LocalizationResult result;
  result.status = run_.status();
  result.match_probability = 1.0 - run_.noneProbability();
  for (const TrackedHypothesis& tracked : run_.result().steps.back().hypotheses) {
    result.hypotheses.push_back(tracked.toHypothesis());
    result.listed += tracked.weight;
  }
  Json json = toJson(result);
  json.erase("statistics");
  json["ms"] = ms;
  return json;
}

Drive::Json Drive::safeJson() const {
  const SafeSet safe = planner_->safeSet(run_.situation());
  return flatChains(safeSetOutline(safe, planner_->params().safe.square));
}

Drive::Json Drive::told(double ms) const {
  const TravelRunResult& result = run_.result();
  const TravelStep& last = result.steps.back();
  const bool is_known = run_.status() == LocalizationStatus::unique;
  // A drive that ended for want of metres or scans was not planned for any more.
  const bool is_planned = !is_known && last.plan.status != TravelStatus::decided;
  Json stops = Json::array(), fallen = Json::array();
  for (const TravelStep& step : result.steps) stops.push_back(poseJson(step.truth));
  for (const Fallen& one : fallen_) {
    Json json = poseJson(one.pose);
    json["weight"] = one.weight;
    json["step"] = one.step;
    fallen.push_back(std::move(json));
  }
  return {{"step", result.steps.size() - 1},
          {"outcome", run_.isOver() ? Json(toString(result.outcome)) : Json(nullptr)},
          {"pose", poseJson(last.truth)},
          {"error", {{"m", finiteOrNull(result.error_m)}, {"rad", finiteOrNull(result.error_rad)}}},
          {"travelled", result.travelled},
          {"scans", result.scans},
          {"collisions", result.collisions},
          {"way", flatPoints(result.way)},
          {"stops", std::move(stops)},
          {"scan", toJson(run_.scan())},
          {"result", resultJson(ms)},
          {"plan", is_planned ? toJson(last.plan) : Json(nullptr)},
          {"safe", is_planned ? safeJson() : Json::array()},
          {"fallen", std::move(fallen)}};
}

}  // namespace mrpt_polyloc::apps
