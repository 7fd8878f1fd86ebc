#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/TravelPlanning.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

double lengthOf(const std::vector<TPoint2D>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

}  // namespace

void TravelPlanning::take(const Choice& choice, TravelPlan& plan) const {
  plan.status = TravelStatus::go;
  plan.goal = choice.value.pose;
  plan.value = choice.value.told;
  plan.falls = choice.value.falls;
  plan.path = ways().pathTo({plan.goal.x, plan.goal.y});
  if (plan.path.empty()) plan.path = {{0, 0}};  // it cannot leave its place, and turns there
  if (plan.path.size() > 1) plan.path.back() = {plan.goal.x, plan.goal.y};
  plan.distance = lengthOf(plan.path);
  cutToSight(plan);
}

void TravelPlanning::cutToSight(TravelPlan& plan) const {
  constexpr double kStep = 0.05;    // [m]
  constexpr double kInSight = 0.7;  // of the robot's radius: noise must not hide a door
  plan.way = {plan.path.front()};
  plan.waypoint = plan.goal;
  double longest_leg = params_.longest_leg;
  if (plan.path.size() > 1 && plan.distance > params_.longest_tight_leg) {
    constexpr double kLargeTurn = 100.0 * kDegree;  // the wheels have lost the heading
    const double bearing = headingAt(plan.path[1]);
    const bool is_turn = std::abs(bearing) > params_.most_turn;
    if (is_turn && (std::abs(bearing) > kLargeTurn || !hasJustTurned())) {
      plan.waypoint = TPose2D(0, 0, bearing);
      return;
    }
    if (is_turn) longest_leg = params_.longest_tight_leg;
  }
  double gone = 0.0;
  for (std::size_t i = 1; i < plan.path.size(); ++i) {
    const TPoint2D from = plan.path[i - 1], along = plan.path[i] - from;
    const double length = along.norm();
    for (double at = kStep; at < length + kStep; at += kStep) {
      const TPoint2D here = from + along * std::min(1.0, at / length);
      const double longest = safe_.isRoomy(here) ? longest_leg : params_.longest_tight_leg;
      const bool may_go = gone + at <= longest && safe_.isReached(here) &&
                          recent_sight_.seesDisc(here, kInSight * params_.safe.robot_radius);
      if (may_go) continue;
      const TPoint2D end = from + along * ((at - kStep) / length);
      if (gone + at > kStep + 1e-9) plan.way.push_back(end);
      plan.waypoint = TPose2D(end.x, end.y, std::atan2(along.y, along.x));
      return;
    }
    gone += length;
    plan.way.push_back(plan.path[i]);
  }
}

bool TravelPlanning::hasJustTurned() const {
  constexpr double kHere = 0.05;  // [m]
  const std::vector<TPose2D>& looked = situation_.looked;
  for (std::size_t i = looked.size(); i-- > 0;) {
    const bool is_here = std::hypot(looked[i].x, looked[i].y) < kHere;
    if (!is_here) return false;
    if (angleBetween(looked[i].phi, 0.0) > 0.5 * params_.most_turn) return true;
  }
  return false;
}

}  // namespace mrpt_polyloc
