#include "next_waypoint.h"

#include "../common/map_input.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/replay_log.h>
#include <mrpt_polyloc/io/scan_files.h>
#include <mrpt_polyloc/travel/HypothesisTracker.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>

#include <mrpt/obs/CActionRobotMovement2D.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;
using nlohmann::ordered_json;

struct Look {
  TPose2D moved{0, 0, 0};  ///< since the look before
  RangeScan scan{std::vector<Beam>{}};
};

bool isRawlog(const std::string& path) {
  return std::filesystem::path(path).filename().string().find(".rawlog") != std::string::npos;
}

/// All scans with the movements between them; the last scan alone where there are none.
std::vector<Look> loadLooks(const Program& program, const TravelOptions& options) {
  Notes notes;
  std::vector<Look> looks;
  if (isRawlog(options.scans)) {
    for (const ReplayStep& step : loadReplayLog(options.scans, options.file, {}, &notes)) {
      Look look{{0, 0, 0}, step.scan};
      const auto movement = step.action ? step.action->getBestMovementEstimation() : nullptr;
      if (movement) look.moved = movement->poseChange->getMeanVal().asTPose();
      looks.push_back(std::move(look));
    }
  } else {
    for (RangeScan& scan : loadScans(options.scans, options.file, &notes)) {
      looks.push_back({{0, 0, 0}, std::move(scan)});
    }
  }
  program.note(options.scans, notes);
  const bool has_moved = std::any_of(looks.begin(), looks.end(), [](const Look& look) {
    return std::hypot(look.moved.x, look.moved.y) > 1e-6 || std::abs(look.moved.phi) > 1e-6;
  });
  if (!has_moved && looks.size() > 1) {
    looks.erase(looks.begin(), looks.end() - 1);
  }
  return looks;
}

/// `b` after `a`.
TPose2D compose(const TPose2D& a, const TPose2D& b) {
  const double c = std::cos(a.phi), s = std::sin(a.phi);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, std::remainder(a.phi + b.phi, kTwoPi)};
}

TPose2D inverse(const TPose2D& a) {
  const double c = std::cos(a.phi), s = std::sin(a.phi);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, -a.phi};
}

ordered_json jsonOf(const TPose2D& pose) {
  return {{"x", pose.x}, {"y", pose.y}, {"phi", pose.phi}};
}

ordered_json jsonOf(const std::vector<TPoint2D>& way) {
  ordered_json json = ordered_json::array();
  for (const TPoint2D& point : way) json.push_back({{"x", point.x}, {"y", point.y}});
  return json;
}

}  // namespace

ordered_json nextWaypoint(const Program& program, const TravelOptions& options) {
  const std::vector<Look> looks = loadLooks(program, options);
  const MapIndex::Ptr index =
      MapIndex::build(loadMapWithWarnings(program, options.map, options.scale).map);
  HypothesisTracker tracker{GlobalLocalizer(index)};
  std::vector<TPose2D> odometry;
  TPose2D at(0, 0, 0);
  for (const Look& look : looks) {
    if (!odometry.empty()) {
      tracker.move(measuredMotion(look.moved, options.run.odometry));
      at = compose(at, look.moved);
    }
    tracker.update(look.scan);
    odometry.push_back(at);
  }

  const TrackingState& state = tracker.state();
  TravelSituation situation;
  ordered_json hypotheses = ordered_json::array();
  for (const TrackedHypothesis& tracked : state.hypotheses) {
    Hypothesis hypothesis;
    hypothesis.pose_map_robot = tracked.pose_map_robot;
    hypothesis.covariance = tracked.covariance;
    hypothesis.weight = tracked.weight;
    situation.hypotheses.push_back(hypothesis);
    ordered_json json = jsonOf(tracked.pose_map_robot);
    json["weight"] = tracked.weight;
    hypotheses.push_back(std::move(json));
  }
  constexpr std::size_t kKept = 3;  // scans that say what stands beside the robot
  for (std::size_t i = looks.size(); i-- > 0;) {
    const TPose2D seen = compose(inverse(odometry.back()), odometry[i]);
    situation.looked.push_back(seen);
    if (situation.scans.size() < kKept) situation.scans.push_back({looks[i].scan, seen});
  }
  situation.most_distance = options.run.most_travel;
  situation.seed = options.seed;

  const TravelPlanner planner(index, options.planner);
  const bool is_known = state.status == LocalizationStatus::unique;
  TravelPlan plan;
  if (!is_known) {
    plan = state.status == LocalizationStatus::ambiguous ? planner.plan(situation)
                                                         : planner.explore(situation);
    if (plan.status == TravelStatus::decided) plan = planner.explore(situation);
  }
  const bool goes = plan.status == TravelStatus::go;
  ordered_json falls = ordered_json::array();
  for (std::size_t i = 0; i < plan.falls.size(); ++i) {
    if (plan.falls[i] > 0.0) falls.push_back({{"hypothesis", i}, {"by", plan.falls[i]}});
  }
  return {{"status", is_known ? "unique" : toString(plan.status)},
          {"localization", toString(state.status)},
          {"none_probability", state.none_probability},
          {"waypoint", goes ? jsonOf(plan.waypoint) : ordered_json(nullptr)},
          {"way", jsonOf(plan.way)},
          {"goal", goes ? jsonOf(plan.goal) : ordered_json(nullptr)},
          {"distance", goes ? ordered_json(plan.distance) : ordered_json(nullptr)},
          {"value", plan.value},
          {"falls", std::move(falls)},
          {"hypotheses", std::move(hypotheses)},
          {"safe_area", plan.safe_area},
          {"planning_ms", plan.planning_ms}};
}

}  // namespace mrpt_polyloc::apps
