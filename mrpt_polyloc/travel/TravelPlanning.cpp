#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/TravelPlanning.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// A scan tells little that was taken so near to one before ...
constexpr double kSameLookWithin = 0.25;
/// ... turned by less than this [rad], if the laser does not see all around.
constexpr double kSameLookTurn = 25.0 * kDegree;
std::vector<PlacedScan> recentOf(const TravelSituation& situation) {
  const std::size_t count = situation.recent_scans > 0
                                ? std::min(situation.recent_scans, situation.scans.size())
                                : situation.scans.size();
  return {situation.scans.begin(), situation.scans.begin() + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace

double ownRadius(const TravelPlannerParams& params) {
  return params.safe.robot_radius + params.safe.margin;
}

TravelPlanning::TravelPlanning(const TravelSituation& situation, const TravelPlannerParams& params,
                               const ClearanceField& field, const RangePredictor& predictor)
    : situation_(situation),
      params_(params),
      field_(field),
      sight_(situation.scans, ownRadius(params)),
      recent_sight_(recentOf(situation), ownRadius(params)),
      safe_(field, situation.hypotheses, sight_, limited(params.safe, 1.0)),
      values_(predictor, field, situation.hypotheses,
              LaserModel::of(situation.scans.front().scan, params.most_beams, params.max_range),
              params) {
  for (const PlacedScan& placed : situation.scans) looked_.push_back(placed.pose);
  looked_.insert(looked_.end(), situation.looked.begin(), situation.looked.end());
  if (params.strategy == TravelStrategy::majority) {
    majority_.emplace(field, situation.hypotheses, sight_, limited(params.safe, 0.5));
  }
}

TravelPlan TravelPlanning::run() {
  TravelPlan plan;
  plan.safe_area =
      static_cast<double>(safe_.reached().size()) * params_.safe.square * params_.safe.square;
  if (!values_.hasPairs()) return plan;
  const bool can_leave = safe_.isStartFree() && reach() >= kLeastReach;
  std::vector<Choice> choices;
  if (can_leave || !values_.seesAllAround()) choices = coarseChoices();
  plan.places = choices.size();
  std::optional<Choice> chosen = choose(choices);
  if (!chosen && can_leave) chosen = denseChoice(plan.places);
  if (!chosen && can_leave && isMoreToSee()) {
    const std::size_t places = plan.places;
    plan = explore(kNewPlace);
    plan.places = places;
    if (plan.status == TravelStatus::go) return plan;
  }
  if (!chosen) {
    plan.status = can_leave ? TravelStatus::indistinguishable : TravelStatus::blocked;
    return plan;
  }
  if (params_.strategy == TravelStrategy::greedy) chosen = soonerOnTheWay(*chosen);
  take(*chosen, plan);
  return plan;
}

SafeSetParams TravelPlanning::limited(SafeSetParams safe, double quorum) const {
  safe.quorum = quorum;
  safe.reach = std::max(safe.square, std::min(safe.reach, situation_.most_distance));
  return safe;
}

bool TravelPlanning::isMoreToSee() const {
  if (!values_.comparesAll()) return true;
  const auto heaviest = std::max_element(
      situation_.hypotheses.begin(), situation_.hypotheses.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.weight < b.weight; });
  const std::vector<Hypothesis> alone{*heaviest};
  const SafeSet its_own(field_, alone, sight_, limited(params_.safe, 1.0));
  constexpr double kMuchMore = 1.2;
  return static_cast<double>(its_own.reached().size()) >
         kMuchMore * static_cast<double>(safe_.reached().size());
}

double TravelPlanning::reach() const {
  double farthest = 0.0;
  for (const SafeSet::Place& place : safe_.reached()) {
    farthest = std::max(farthest, place.distance);
  }
  return farthest;
}

bool TravelPlanning::wasLookedFrom(const TPose2D& pose) const {
  return std::any_of(looked_.begin(), looked_.end(), [&](const TPose2D& before) {
    return std::hypot(pose.x - before.x, pose.y - before.y) < kSameLookWithin &&
           (values_.seesAllAround() || angleBetween(pose.phi, before.phi) < kSameLookTurn);
  });
}

double TravelPlanning::headingAt(const TPoint2D& place) const {
  return place.norm() < 1e-9 ? 0.0 : std::atan2(place.y, place.x);
}

}  // namespace mrpt_polyloc
