#include "plan_json.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace mrpt_polyloc::apps {
namespace {

using nlohmann::ordered_json;

ordered_json jsonOf(const mrpt::math::TPose2D& pose) {
  return {{"x", pose.x}, {"y", pose.y}, {"phi", pose.phi}};
}

ordered_json jsonOf(const std::vector<mrpt::math::TPoint2D>& way) {
  ordered_json json = ordered_json::array();
  for (const mrpt::math::TPoint2D& point : way) json.push_back({{"x", point.x}, {"y", point.y}});
  return json;
}

}  // namespace

ordered_json toJson(const TravelPlan& plan) {
  const bool goes = plan.status == TravelStatus::go;
  ordered_json falls = ordered_json::array();
  for (std::size_t i = 0; i < plan.falls.size(); ++i) {
    if (plan.falls[i] > 0.0) falls.push_back({{"hypothesis", i}, {"by", plan.falls[i]}});
  }
  return {{"status", toString(plan.status)},
          {"waypoint", goes ? jsonOf(plan.waypoint) : ordered_json(nullptr)},
          {"way", jsonOf(plan.way)},
          {"goal", goes ? jsonOf(plan.goal) : ordered_json(nullptr)},
          {"path", jsonOf(plan.path)},
          {"distance", goes ? ordered_json(plan.distance) : ordered_json(nullptr)},
          {"value", plan.value},
          {"falls", std::move(falls)},
          {"safe_area", plan.safe_area},
          {"planning_ms", plan.planning_ms}};
}

}  // namespace mrpt_polyloc::apps
