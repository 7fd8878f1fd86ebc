#include "TravelRun.h"

#include <mrpt_polyloc/base/angles.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

/// Enough of a drive that rooms and doors of one floor differ, not so much that it costs seconds.
LastMetresParams drivenMetres() {
  LastMetresParams params;
  params.length = 12.0;
  params.spacing = 0.8;
  params.most_moments = 10;
  params.longest_step = 5.0;
  return params;
}

/// Hypotheses of a search: lasers of short range see the same in very many places.
constexpr std::size_t kMostOfOne = 100, kMostOfDrive = 50;
/// A list that holds so much of the posterior is whole.
constexpr double kWhole = 0.97;
/// The probability that an answer by the first scan alone must have: it is the last word.
constexpr double kSureOfOne = 0.98;
/// The weight that an answer must have by the last metres together.
constexpr double kSure = 0.99;
/// What the map does not have lowers the probability of a match, the more so the more scans see it.
/// After so long a drive [m] ...
constexpr double kLongDrive = 3.0;
/// ... it only bars answers that fit badly all along.
constexpr double kLeastMatch = 0.25;
/// From this probability that none of the hypotheses is right on nothing is made of them.
constexpr double kLost = 0.9;

double lengthOf(const ScanSet& drive) {
  double length = 0.0;
  for (std::size_t i = 1; i < drive.moments().size(); ++i) {
    length += drive.moments()[i].since_before.length();
  }
  return length;
}

HypothesisTrackerParams trackerParams() {
  HypothesisTrackerParams params;
  params.max_hypotheses = kMostOfOne;
  return params;
}

}  // namespace

GlobalLocalizerParams surerSearch() {
  GlobalLocalizerParams params;
  params.sure_probability = 1.0;
  return params;
}

TravelRun::TravelRun(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                     const World& world, const TPose2D& start, const TravelRunParams& params,
                     std::uint64_t seed)
    : planner_(planner),
      localizer_(localizer),
      world_(world),
      params_(params),
      tracker_(localizer, trackerParams(), params.prior),
      noise_(seed),
      seed_(seed),
      truth_(start),
      last_metres_(drivenMetres()) {
  result_.start = start;
  result_.way = {{start.x, start.y}};
}

void TravelRun::look() {
  constexpr std::size_t kKept = 25;  // scans: enough for the way back out of a dead end
  scans_.insert(scans_.begin(), {world_.scan(truth_, noise_), odometry_});
  if (scans_.size() > kKept) scans_.pop_back();
  ++result_.scans;
  const ScanSet drive = last_metres_.add({scans_.front().scan}, since_scan_);
  since_scan_ = Motion();
  is_searched_now_ = false;
  follow(drive);
  answer_ = conclude(drive);
  looked_.push_back(odometry_);
  if (result_.scans == 1) {
    result_.first_scan = scans_.front().scan;
    result_.is_ambiguous_at_start = !answer_;
  }
  result_.steps.push_back({truth_, tracker_.state().hypotheses, {}, result_.travelled});
  measureError();
  decide();
}

void TravelRun::decide() {
  if (answer_) {
    const bool is_right = isRight(*answer_, truth_, params_.tolerance);
    result_.outcome = is_right ? TravelOutcome::localized : TravelOutcome::wrong;
    is_over_ = true;
    return;
  }
  if (result_.scans >= params_.most_scans || result_.travelled >= params_.most_travel) {
    is_over_ = true;
    return;
  }
  situation_ = situationNow();
  TravelPlan& plan = result_.steps.back().plan;
  plan = makePlan();
  result_.planning_ms.push_back(plan.planning_ms);
  if (plan.status == TravelStatus::indistinguishable) {
    result_.outcome = TravelOutcome::indistinguishable;
    is_over_ = true;
    return;
  }
  // Someone in the way may be gone in the next scan.
  constexpr int kMostBlocked = 8;
  const bool moves = plan.status == TravelStatus::go &&
                     (plan.way.size() > 1 || std::abs(plan.waypoint.phi) > 2.0 * kDegree);
  blocked_ = moves ? 0 : blocked_ + 1;
  is_over_ = blocked_ > kMostBlocked;
}

LocalizationStatus TravelRun::status() const {
  if (answer_) return LocalizationStatus::unique;
  const LocalizationStatus tracked = tracker_.state().status;
  return tracked == LocalizationStatus::unique ? LocalizationStatus::ambiguous : tracked;
}

/// What was known of the start, carried on by the wheels and three standard deviations of theirs.
PosePrior TravelRun::priorNow() const {
  PosePrior prior = params_.prior;
  if (prior.compass) {
    const MotionNoise& noise = params_.odometry;
    const double lost =
        noise.heading_per_metre * result_.travelled + noise.heading_per_radian * turned_;
    prior.compass->heading += odometry_.phi;
    prior.compass->tolerance = std::min(kPi, prior.compass->tolerance + 3.0 * lost);
  }
  if (prior.near) {
    prior.near->radius += (1.0 + 3.0 * params_.odometry.position_per_metre) * result_.travelled;
  }
  return prior;
}

/// Lasers of short range see the same in so many places that a search cannot list them all. What
/// is concluded among some of them is worth nothing: the last metres are searched anew with each
/// scan until there is a list that is whole.
void TravelRun::follow(const ScanSet& drive) {
  if (!is_anchored_ || isLost()) return search(drive);
  const TrackingState& state = tracker_.update(drive.now().scans);
  if (state.has_searched) is_anchored_ = state.listed >= kWhole;
}

/// The tracker goes on with what the scans of the last metres say together.
void TravelRun::search(const ScanSet& drive) {
  SearchOptions options;
  options.max_hypotheses = drive.single() != nullptr ? kMostOfOne : kMostOfDrive;
  options.unite_valleys = false;
  if (!is_searched_now_) searched_ = localizer_.localize(drive, priorNow(), options);
  is_searched_now_ = true;
  const std::vector<Hypothesis>& found = searched_.hypotheses;
  const bool is_cut = found.size() == options.max_hypotheses &&
                      found.back().weight >= tracker_.params().least_weight;
  is_anchored_ = searched_.listed >= kWhole && !is_cut;
  tracker_.start(searched_);
}

/// The pose that the robot is sure of: the tracker's, if the scans of the last metres, searched
/// anew and judged together, have the same answer. If they have another, or several, the tracker
/// goes on with those: it followed what was left of a list without the truth.
std::optional<TPose2D> TravelRun::conclude(const ScanSet& drive) {
  const TrackingState& state = tracker_.state();
  if (!is_anchored_ || state.hypotheses.empty()) return std::nullopt;
  const TrackedHypothesis first = state.hypotheses.front();
  if (drive.single() != nullptr) {
    const bool is_sure =
        searched_.status == LocalizationStatus::unique && first.weight >= kSureOfOne;
    return is_sure ? std::optional<TPose2D>(first.pose_map_robot) : std::nullopt;
  }
  if (state.status != LocalizationStatus::unique) return std::nullopt;
  search(drive);
  double near = 0.0;
  for (const Hypothesis& hypothesis : searched_.hypotheses) {
    if (isRight(hypothesis.pose_map_robot, first.pose_map_robot, kSamePlace)) {
      near += hypothesis.weight;
    }
  }
  const bool is_known =
      searched_.status == LocalizationStatus::unique ||
      (lengthOf(drive) >= kLongDrive && searched_.match_probability >= kLeastMatch);
  return near >= kSure && is_known ? std::optional<TPose2D>(first.pose_map_robot) : std::nullopt;
}

bool TravelRun::isLost() const {
  const TrackingState& state = tracker_.state();
  return state.hypotheses.empty() || state.none_probability > kLost;
}

TravelSituation TravelRun::situationNow() const {
  TravelSituation situation;
  // Maps tell where it is free while there are hypotheses to ask; else what was seen before.
  constexpr std::size_t kRecent = 3;
  const bool knows_enough = is_anchored_ && !isLost();
  for (const TrackedHypothesis& tracked : tracker_.state().hypotheses) {
    if (!knows_enough) break;
    situation.hypotheses.push_back(tracked.toHypothesis());
  }
  for (const PlacedScan& placed : scans_) {
    if (knows_enough && situation.scans.size() == kRecent) break;
    situation.scans.push_back({placed.scan, placed.pose - odometry_});
  }
  for (const TPose2D& before : looked_) situation.looked.push_back(before - odometry_);
  situation.most_distance = params_.most_travel - result_.travelled;
  situation.recent_scans = kRecent;
  situation.seed = seed_ * 1000 + result_.scans;
  return situation;
}

TravelPlan TravelRun::makePlan() const {
  if (!is_anchored_ || isLost()) return planner_.explore(situation_);
  TravelPlan plan = planner_.plan(situation_);
  if (plan.status != TravelStatus::decided) return plan;
  return planner_.explore(situation_);
}

void TravelRun::drive() {
  if (is_over_ || result_.steps.empty()) return;
  const TravelPlan& plan = result_.steps.back().plan;
  if (plan.status != TravelStatus::go) return;
  const TPose2D before = odometry_;
  Motion measured;
  TPose2D at(0, 0, 0);  // of the way, seen from where it starts
  for (std::size_t i = 1; i < plan.way.size(); ++i) {
    const TPoint2D along = plan.way[i] - TPoint2D(at.x, at.y);
    const double heading = std::atan2(along.y, along.x);
    measured = measured + move({0, 0, std::remainder(heading - at.phi, kTwoPi)});
    measured = measured + move({along.norm(), 0, 0});
    at = {plan.way[i].x, plan.way[i].y, heading};
  }
  measured = measured + move({0, 0, std::remainder(plan.waypoint.phi - at.phi, kTwoPi)});
  tracker_.move(measured);
  since_scan_ = measured;
  odometry_ = before + measured.pose_before_after;
}

/// One turn or straight piece, as it is measured; the truth goes astray.
Motion TravelRun::move(const TPose2D& told) {
  const double length = std::hypot(told.x, told.y);
  turned_ += std::abs(told.phi);
  const MotionNoise& with = params_.odometry;
  const double along = with.position_per_metre * length * noise_.normal();
  const double across = with.position_per_metre * length * noise_.normal();
  const double turn =
      (with.heading_per_metre * length + with.heading_per_radian * std::abs(told.phi)) *
      noise_.normal();
  const TPose2D start = truth_;
  const TPose2D end = start + TPose2D(told.x + along, told.y + across, told.phi + turn);
  if (length > 0.0) {
    const auto steps = static_cast<int>(std::ceil(length / 0.02));
    bool touches = false;
    for (int k = 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      touches = touches || world_.clearance({start.x + share * (end.x - start.x),
                                             start.y + share * (end.y - start.y)}) <
                               planner_.params().safe.robot_radius;
    }
    result_.collisions += touches ? 1 : 0;
    result_.travelled += std::hypot(end.x - start.x, end.y - start.y);
    result_.way.emplace_back(end.x, end.y);
  }
  truth_ = end;
  return measuredMotion(told, params_.odometry);
}

void TravelRun::measureError() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  result_.error_m = result_.error_rad = nan;
  const std::vector<TrackedHypothesis>& hypotheses = tracker_.state().hypotheses;
  if (hypotheses.empty() && !answer_) return;
  const TPose2D& first = answer_ ? *answer_ : hypotheses.front().pose_map_robot;
  result_.error_m = std::hypot(first.x - truth_.x, first.y - truth_.y);
  result_.error_rad = angleBetween(first.phi, truth_.phi);
}

const char* toString(TravelOutcome outcome) {
  switch (outcome) {
    case TravelOutcome::localized:
      return "localized";
    case TravelOutcome::wrong:
      return "wrong";
    case TravelOutcome::indistinguishable:
      return "indistinguishable";
    case TravelOutcome::gave_up:
      break;
  }
  return "gave_up";
}

TravelRunResult travel(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                       const World& world, const TPose2D& start, const TravelRunParams& params,
                       std::uint64_t seed) {
  TravelRun run(planner, localizer, world, start, params, seed);
  run.look();
  while (!run.isOver()) {
    run.drive();
    run.look();
  }
  return run.result();
}

}  // namespace mrpt_polyloc::apps
