#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/travel/TravelPlanner.h>
#include <mrpt_polyloc/travel/TravelValues.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// A scan tells little that was taken so near to one before ...
constexpr double kSamePlace = 0.25;
/// ... turned by less than this [rad], if the laser does not see all around.
constexpr double kSameHeading = 25.0 * kDegree;
/// Exploring is over where the robot has looked from this near to every place [m].
constexpr double kNewPlace = 1.0;
/// A robot that gets no farther than this cannot leave its place [m].
constexpr double kLeastReach = 0.3;

struct Choice {
  TravelValues::Value value;
  double distance;  ///< [m]
};

/// So much around the robot is taken as free, or one whose laser does not see all around could
/// never start: the disc that it takes up when it begins to move.
double ownRadius(const TravelPlannerParams& params) {
  return params.safe.robot_radius + params.safe.margin;
}

std::vector<PlacedScan> recentOf(const TravelSituation& situation) {
  const std::size_t count = situation.recent_scans > 0
                                ? std::min(situation.recent_scans, situation.scans.size())
                                : situation.scans.size();
  return {situation.scans.begin(), situation.scans.begin() + static_cast<std::ptrdiff_t>(count)};
}

double lengthOf(const std::vector<TPoint2D>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

/// One plan in the making.
class Planning {
 public:
  Planning(const TravelSituation& situation, const TravelPlannerParams& params,
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

  TravelPlan run() {
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

  /// \param least how far a place must be from all it looked from, to be gone to [m]
  TravelPlan explore(double least = 0.0) {
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

 private:
  /// The place that is the farthest from all it looked from, or far enough, and of these the one
  /// that is the least effort; none if all are nearer than `least`.
  std::optional<SafeSet::Place> farthestNew(double least, bool mapped_alone) const {
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

  /// Whether half of the hypotheses, by weight, have free space of the map here.
  bool isMapped(const TPoint2D& place) const {
    double for_it = 0.0, all = 0.0;
    for (const Hypothesis& hypothesis : situation_.hypotheses) {
      all += hypothesis.weight;
      if (clearanceAt(field_, hypothesis.pose_map_robot, place) > 0.0) for_it += hypothesis.weight;
    }
    return 2.0 * for_it >= all;
  }

  /// To look from where it is to where it has not looked, or `blocked`: a robot that stands before
  /// a wall with its only laser must turn to see how it gets away.
  TravelPlan turned() const {
    TravelPlan plan;
    plan.status = TravelStatus::blocked;
    const std::vector<Beam>& beams = situation_.scans.front().scan.beams();
    const bool is_blind = std::all_of(beams.begin(), beams.end(), [](const Beam& beam) {
      return beam.kind == BeamKind::invalid;
    });
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

  SafeSetParams limited(SafeSetParams safe, double quorum) const {
    safe.quorum = quorum;
    safe.reach = std::max(safe.square, std::min(safe.reach, situation_.most_distance));
    return safe;
  }

  /// Whether what is told here can change by driving on: not all hypotheses were compared, or their
  /// common safe set ends where one of them alone could go on. There it is bounded by what was
  /// seen, or by doubts of some centimetres.
  bool isMoreToSee() const {
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

  /// Where ways are planned.
  const SafeSet& ways() const { return majority_ ? *majority_ : safe_; }

  /// What speaks against a place to explore [m]. A robot that sees walls follows them, for that is
  /// where something differs; one that sees none goes straight on until it does.
  static double effortOf(const SafeSet::Place& place, const Sight& now) {
    constexpr double kBeside = 1.5;  // [m] from a wall it is seen well by any laser
    const TPoint2D& at = place.point;
    if (now.hits().empty()) return 2.0 * std::abs(at.y) - at.x;
    double nearest = 1e9;
    for (const TPoint2D& hit : now.hits()) nearest = std::min(nearest, (hit - at).norm());
    const double turn = std::abs(std::atan2(at.y, at.x));
    return place.distance + 1.5 * std::max(0.0, nearest - kBeside) + 0.5 * turn;
  }

  /// How far the robot gets [m].
  double reach() const {
    double farthest = 0.0;
    for (const SafeSet::Place& place : safe_.reached()) {
      farthest = std::max(farthest, place.distance);
    }
    return farthest;
  }

  bool wasLookedFrom(const TPose2D& pose) const {
    return std::any_of(looked_.begin(), looked_.end(), [&](const TPose2D& before) {
      return std::hypot(pose.x - before.x, pose.y - before.y) < kSamePlace &&
             (values_.seesAllAround() || angleBetween(pose.phi, before.phi) < kSameHeading);
    });
  }

  /// Whether the last look but this was from here and turned: where two ways are nearly as good the
  /// robot would turn to and fro.
  bool hasJustTurned() const {
    constexpr double kHere = 0.05;  // [m]
    const std::vector<TPose2D>& looked = situation_.looked;
    for (std::size_t i = looked.size(); i-- > 0;) {
      const bool is_here = std::hypot(looked[i].x, looked[i].y) < kHere;
      if (!is_here) return false;
      if (angleBetween(looked[i].phi, 0.0) > 0.5 * params_.most_turn) return true;
    }
    return false;
  }

  /// How the robot would come to a place: along its last step.
  double headingAt(const TPoint2D& place) const {
    return place.norm() < 1e-9 ? 0.0 : std::atan2(place.y, place.x);
  }

  /// Places at which something new may be seen, nearest first, with what they tell.
  std::vector<Choice> valued(const std::vector<SafeSet::Place>& places) const {
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

  std::vector<Choice> coarseChoices() const {
    double spacing = 4.0 * params_.safe.square;
    std::vector<SafeSet::Place> places = ways().places(spacing);
    while (places.size() > params_.most_places) {
      spacing *= 1.3;
      places = ways().places(spacing);
    }
    return valued(places);
  }

  std::optional<Choice> choose(const std::vector<Choice>& choices) const {
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

  double scoreOf(const Choice& choice, double most) const {
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

  /// Looks closely, also again from where it was looked before, before nothing is said to differ.
  std::optional<Choice> denseChoice(std::size_t& looked_at) const {
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

  /// The place on the way from which nearly as much is told.
  Choice soonerOnTheWay(const Choice& choice) const {
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

  void take(const Choice& choice, TravelPlan& plan) const {
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

  /// The waypoint: where the path leaves what is in sight, or what all hypotheses call safe.
  void cutToSight(TravelPlan& plan) const {
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

  const TravelSituation& situation_;
  const TravelPlannerParams& params_;
  const ClearanceField& field_;
  Sight sight_;         ///< by which places are safe
  Sight recent_sight_;  ///< by which the robot drives on
  SafeSet safe_;
  std::optional<SafeSet> majority_;
  TravelValues values_;
  std::vector<TPose2D> looked_;
};

}  // namespace

const char* toString(TravelStatus status) {
  switch (status) {
    case TravelStatus::go:
      return "go";
    case TravelStatus::decided:
      return "decided";
    case TravelStatus::indistinguishable:
      return "indistinguishable";
    case TravelStatus::blocked:
      break;
  }
  return "blocked";
}

const char* toString(TravelStrategy strategy) {
  switch (strategy) {
    case TravelStrategy::greedy:
      return "greedy";
    case TravelStrategy::nearest:
      return "nearest";
    case TravelStrategy::majority:
      return "majority";
    case TravelStrategy::random:
      break;
  }
  return "random";
}

std::optional<TravelStrategy> travelStrategyFrom(const std::string& name) {
  for (const TravelStrategy strategy : {TravelStrategy::greedy, TravelStrategy::nearest,
                                        TravelStrategy::majority, TravelStrategy::random}) {
    if (name == toString(strategy)) return strategy;
  }
  return std::nullopt;
}

void TravelPlannerParams::check() const {
  safe.check();
  readings.check();
  evidence.check();
  requireInRange("most_beams", static_cast<double>(most_beams), 1.0, 1e5);
  requireNotNegative("max_range", max_range);
  requireInRange("most_places", static_cast<double>(most_places), 1.0, 1e6);
  requireInRange("most_hypotheses", static_cast<double>(most_hypotheses), 2.0, 1e4);
  requireInRange("least_weight", least_weight, 0.0, 1.0);
  requireInRange("least_telling", least_telling, 1e-6, 1.0);
  requirePositive("stop_cost", stop_cost);
  requirePositive("longest_leg", longest_leg);
  requirePositive("longest_tight_leg", longest_tight_leg);
  requirePositive("most_turn", most_turn);
  requirePositive("dense_spacing", dense_spacing);
  requireInRange("most_dense_places", static_cast<double>(most_dense_places), 1.0, 1e7);
}

TravelPlanner::TravelPlanner(MapIndex::Ptr index, TravelPlannerParams params)
    : index_(index != nullptr ? std::move(index)
                              : throw InvalidParamsError("TravelPlanner: there is no index")),
      params_((params.check(), params)),
      field_(index_->map(), params.safe.robot_radius + params.safe.margin +
                                params.safe.most_uncertainty + params.safe.comfort +
                                ClearanceField::kSquare) {
  params_.evidence = params_.evidence.of(index_->map());
  index_->parts().predictor();
}

TravelPlan TravelPlanner::plan(const TravelSituation& situation) const {
  if (situation.scans.empty()) throw InvalidParamsError("TravelSituation: there is no scan");
  const Stopwatch watch;
  const RangePredictor& predictor = index_->parts().predictor();
  TravelPlan plan = Planning(situation, params_, field_, predictor).run();
  if (plan.status != TravelStatus::decided && !(plan.value > 0.0)) {
    // Doubts of some centimetres must not close a door for good.
    TravelPlannerParams bold = params_;
    bold.safe.most_uncertainty = 0.0;
    TravelPlan other = Planning(situation, bold, field_, predictor).run();
    if (other.value > 0.0 || plan.status == TravelStatus::blocked) plan = std::move(other);
  }
  plan.planning_ms = 1e3 * watch.seconds();
  return plan;
}

TravelPlan TravelPlanner::explore(const TravelSituation& situation) const {
  if (situation.scans.empty()) throw InvalidParamsError("TravelSituation: there is no scan");
  const Stopwatch watch;
  TravelPlan plan = Planning(situation, params_, field_, index_->parts().predictor()).explore();
  plan.planning_ms = 1e3 * watch.seconds();
  return plan;
}

SafeSet TravelPlanner::safeSet(const TravelSituation& situation) const {
  const Sight sight(situation.scans, ownRadius(params_));
  SafeSetParams safe = params_.safe;
  safe.reach = std::max(safe.square, std::min(safe.reach, situation.most_distance));
  return SafeSet(field_, situation.hypotheses, sight, safe);
}

}  // namespace mrpt_polyloc
