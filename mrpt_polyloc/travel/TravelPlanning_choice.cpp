#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/travel/TravelPlanning.h>

#include <algorithm>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

}  // namespace

std::vector<TravelPlanning::Choice> TravelPlanning::valued(
    const std::vector<SafeSet::Place>& places) const {
  std::vector<Choice> choices;
  for (const SafeSet::Place& place : places) {
    if (place.distance > situation_.most_distance) continue;
    if (values_.seesAllAround() && wasLookedFrom({place.point.x, place.point.y, 0.0})) continue;
    TravelValues::Value value = values_.at(place.point, headingAt(place.point));
    if (wasLookedFrom(value.pose)) continue;
    choices.push_back({std::move(value), place.distance});
  }
  return choices;
}

std::vector<TravelPlanning::Choice> TravelPlanning::coarseChoices() const {
  double spacing = 4.0 * params_.safe.square;
  std::vector<SafeSet::Place> places = ways().places(spacing);
  while (places.size() > params_.most_places) {
    spacing *= 1.3;
    places = ways().places(spacing);
  }
  return valued(places);
}

std::optional<TravelPlanning::Choice> TravelPlanning::choose(
    const std::vector<Choice>& choices) const {
  const Choice* best = nullptr;
  double most = 0.0;
  for (const Choice& choice : choices) most = std::max(most, choice.value.told);
  if (most <= 0.0) return std::nullopt;
  if (params_.strategy == TravelStrategy::random) {
    Random random(situation_.seed);
    const auto at = static_cast<std::size_t>(random.unit() * static_cast<double>(choices.size()));
    return choices[at];
  }
  double best_score = 0.0;
  for (const Choice& choice : choices) {
    const double score = scoreOf(choice, most);
    if (score > best_score) {
      best_score = score;
      best = &choice;
    }
  }
  return best == nullptr ? std::nullopt : std::optional<Choice>(*best);
}

double TravelPlanning::scoreOf(const Choice& choice, double most) const {
  const double nearness = 1.0 / (choice.distance + params_.stop_cost);
  switch (params_.strategy) {
    case TravelStrategy::nearest:
      return choice.value.told > 0.0 ? nearness : 0.0;
    case TravelStrategy::majority:
      return choice.value.told >= 0.5 * most ? nearness : 0.0;
    case TravelStrategy::greedy:
    case TravelStrategy::random:
      break;
  }
  return choice.value.told * nearness;
}

std::optional<TravelPlanning::Choice> TravelPlanning::denseChoice(std::size_t& looked_at) const {
  double spacing = params_.dense_spacing;
  std::vector<SafeSet::Place> places = ways().places(spacing);
  while (places.size() > params_.most_dense_places) {
    spacing *= 1.3;
    places = ways().places(spacing);
  }
  looked_at += places.size();
  for (const bool again : {false, true}) {
    for (const SafeSet::Place& place : places) {  // nearest first: the first that tells will do
      if (place.distance > situation_.most_distance) continue;
      const TPose2D pose(place.point.x, place.point.y, headingAt(place.point));
      if (values_.seesAllAround() && wasLookedFrom(pose) != again) continue;
      TravelValues::Value value = values_.at(place.point, pose.phi);
      if (value.told > 0.0 && wasLookedFrom(value.pose) == again) {
        return Choice{std::move(value), place.distance};
      }
    }
  }
  return std::nullopt;
}

TravelPlanning::Choice TravelPlanning::soonerOnTheWay(const Choice& choice) const {
  constexpr double kNearlyAll = 0.95;
  constexpr double kStep = 0.25;  // [m]
  const std::vector<TPoint2D> path = ways().pathTo({choice.value.pose.x, choice.value.pose.y});
  double along = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double length = (path[i] - path[i - 1]).norm();
    for (double at = kStep; at < length; at += kStep) {
      const TPoint2D place = path[i - 1] + (path[i] - path[i - 1]) * (at / length);
      if (wasLookedFrom({place.x, place.y, choice.value.pose.phi})) continue;
      TravelValues::Value value = values_.at(TPose2D(place.x, place.y, choice.value.pose.phi));
      if (value.told >= kNearlyAll * choice.value.told) return {std::move(value), along + at};
    }
    along += length;
  }
  return choice;
}

}  // namespace mrpt_polyloc
