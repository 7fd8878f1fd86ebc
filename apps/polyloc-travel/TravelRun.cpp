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

}  // namespace

TravelRun::TravelRun(const TravelPlanner& planner, const GlobalLocalizer& localizer,
                     const World& world, const TPose2D& start, const TravelRunParams& params,
                     std::uint64_t seed)
    : planner_(planner),
      world_(world),
      params_(params),
      belief_(localizer, params.odometry, params.prior),
      noise_(seed),
      seed_(seed),
      truth_(start) {
  result_.start = start;
  result_.way = {{start.x, start.y}};
}

void TravelRun::look() {
  constexpr std::size_t kKept = 25;  // scans: enough for the way back out of a dead end
  scans_.insert(scans_.begin(), {world_.scan(truth_, noise_), odometry_});
  if (scans_.size() > kKept) scans_.pop_back();
  ++result_.scans;
  belief_.look(scans_.front().scan);
  looked_.push_back(odometry_);
  if (result_.scans == 1) {
    result_.first_scan = scans_.front().scan;
    result_.is_ambiguous_at_start = !belief_.answer();
  }
  result_.steps.push_back({truth_, belief_.state().hypotheses, {}, result_.travelled});
  measureError();
  decide();
}

void TravelRun::decide() {
  if (belief_.answer()) {
    const bool is_right = isRight(*belief_.answer(), truth_, params_.tolerance);
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
  if (belief_.answer()) return LocalizationStatus::unique;
  const LocalizationStatus tracked = belief_.state().status;
  return tracked == LocalizationStatus::unique ? LocalizationStatus::ambiguous : tracked;
}

TravelSituation TravelRun::situationNow() const {
  TravelSituation situation;
  // Maps tell where it is free while there are hypotheses to ask; else what was seen before.
  constexpr std::size_t kRecent = 3;
  const bool knows_enough = belief_.isKnowing();
  for (const TrackedHypothesis& tracked : belief_.state().hypotheses) {
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
  if (!belief_.isKnowing()) return explore();
  TravelPlan plan = planner_.plan(situation_);
  return plan.status != TravelStatus::decided ? plan : explore();
}

/// By all scans that are kept; where those would not let it go, by the last ones alone: the wheels
/// have misplaced the others the more the farther it drove.
TravelPlan TravelRun::explore() const {
  TravelPlan plan = planner_.explore(situation_);
  const std::size_t recent = situation_.recent_scans;
  if (plan.status != TravelStatus::blocked || situation_.scans.size() <= recent) return plan;
  TravelSituation last = situation_;
  last.scans.erase(last.scans.begin() + static_cast<std::ptrdiff_t>(recent), last.scans.end());
  return planner_.explore(last);
}

void TravelRun::drive() {
  if (is_over_ || result_.steps.empty()) return;
  const TravelPlan& plan = result_.steps.back().plan;
  if (plan.status != TravelStatus::go) return;
  const TPose2D before = odometry_;
  Motion measured;
  double turned = 0.0;
  const auto turn = [&](double by) {
    by = std::remainder(by, kTwoPi);
    turned += std::abs(by);
    measured = measured + move({0, 0, by});
  };
  TPose2D at(0, 0, 0);  // of the way, seen from where it starts
  for (std::size_t i = 1; i < plan.way.size(); ++i) {
    const TPoint2D along = plan.way[i] - TPoint2D(at.x, at.y);
    const double heading = std::atan2(along.y, along.x);
    turn(heading - at.phi);
    measured = measured + move({along.norm(), 0, 0});
    at = {plan.way[i].x, plan.way[i].y, heading};
  }
  turn(plan.waypoint.phi - at.phi);
  belief_.move(measured, turned);
  odometry_ = before + measured.pose_before_after;
}

/// One turn or straight piece, as it is measured; the truth goes astray.
Motion TravelRun::move(const TPose2D& told) {
  const double length = std::hypot(told.x, told.y);
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
  const std::vector<TrackedHypothesis>& hypotheses = belief_.state().hypotheses;
  if (hypotheses.empty() && !belief_.answer()) return;
  const TPose2D& first = belief_.answer() ? *belief_.answer() : hypotheses.front().pose_map_robot;
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
