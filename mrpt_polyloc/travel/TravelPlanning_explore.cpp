#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/TravelPlanning.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

}  // namespace

TravelPlan TravelPlanning::explore(double least) {
  TravelPlan plan;
  plan.status = TravelStatus::blocked;
  if (!safe_.isStartFree() || reach() < kLeastReach) return turned();
  // What is in no map may never end.
  std::optional<SafeSet::Place> chosen = farthestNew(std::max(least, kNewPlace), true);
  if (!chosen) chosen = farthestNew(least, false);
  if (!chosen) return turned();
  TravelValues::Value value;
  value.pose = TPose2D(chosen->point.x, chosen->point.y, headingAt(chosen->point));
  value.falls.assign(situation_.hypotheses.size(), 0.0);
  take({std::move(value), chosen->distance}, plan);
  return plan;
}

std::optional<SafeSet::Place> TravelPlanning::farthestNew(double least, bool mapped_alone) const {
  // From a place so far from all where it looked something new is seen.
  constexpr double kNews = 2.0;  // [m]
  const Sight now({situation_.scans.front()}, ownRadius(params_));
  std::optional<SafeSet::Place> chosen;
  double most = least, best = 0.0;
  for (const SafeSet::Place& place : safe_.places(2.0 * params_.safe.square)) {
    if (place.distance > situation_.most_distance) continue;
    if (mapped_alone && !isMapped(place.point)) continue;
    double apart = kNews;
    for (const TPose2D& before : looked_) {
      apart = std::min(apart, std::hypot(place.point.x - before.x, place.point.y - before.y));
    }
    const double effort = effortOf(place, now);
    if (apart < most || (chosen && apart == most && effort >= best)) continue;
    most = apart;
    best = effort;
    chosen = place;
  }
  return chosen;
}

bool TravelPlanning::isMapped(const TPoint2D& place) const {
  double for_it = 0.0, all = 0.0;
  for (const Hypothesis& hypothesis : situation_.hypotheses) {
    all += hypothesis.weight;
    if (clearanceAt(field_, hypothesis.pose_map_robot, place) > 0.0) for_it += hypothesis.weight;
  }
  return 2.0 * for_it >= all;
}

TravelPlan TravelPlanning::turned() const {
  TravelPlan plan;
  plan.status = TravelStatus::blocked;
  const std::vector<Beam>& beams = situation_.scans.front().scan.beams();
  const bool is_blind = std::all_of(
      beams.begin(), beams.end(), [](const Beam& beam) { return beam.kind == BeamKind::invalid; });
  if (values_.seesAllAround() || is_blind) return plan;
  for (const double turn : {0.5 * kPi, -0.5 * kPi, kPi}) {
    TravelValues::Value value;
    value.pose = TPose2D(0, 0, turn);
    value.falls.assign(situation_.hypotheses.size(), 0.0);
    if (wasLookedFrom(value.pose)) continue;
    take({std::move(value), 0.0}, plan);
    return plan;
  }
  return plan;
}

double TravelPlanning::effortOf(const SafeSet::Place& place, const Sight& now) {
  constexpr double kBeside = 1.5;  // [m] from a wall it is seen well by any laser
  const TPoint2D& at = place.point;
  if (now.hits().empty()) return 2.0 * std::abs(at.y) - at.x;
  double nearest = 1e9;
  for (const TPoint2D& hit : now.hits()) nearest = std::min(nearest, (hit - at).norm());
  const double turn = std::abs(std::atan2(at.y, at.x));
  return place.distance + 1.5 * std::max(0.0, nearest - kBeside) + 0.5 * turn;
}

}  // namespace mrpt_polyloc
