#include "TravelRun.h"

#include <mrpt_polyloc/base/angles.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mrpt_polyloc::apps {
namespace {

using mrpt::math::TPose2D;

TPose2D compose(const TPose2D& a, const TPose2D& b) {
  const double c = std::cos(a.phi), s = std::sin(a.phi);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, std::remainder(a.phi + b.phi, kTwoPi)};
}

/// `b` seen from `a`.
TPose2D seenFrom(const TPose2D& a, const TPose2D& b) {
  const double c = std::cos(a.phi), s = std::sin(a.phi), dx = b.x - a.x, dy = b.y - a.y;
  return {c * dx + s * dy, -s * dx + c * dy, std::remainder(b.phi - a.phi, kTwoPi)};
}

class Run {
 public:
  Run(const TravelPlanner& planner, const GlobalLocalizer& localizer, const World& world,
      const TPose2D& start, const TravelRunParams& params, std::uint64_t seed)
      : planner_(planner),
        world_(world),
        params_(params),
        tracker_(localizer, trackerParams()),
        noise_(seed),
        seed_(seed),
        truth_(start) {
    result_.start = start;
    result_.way = {{start.x, start.y}};
  }

  TravelRunResult go() {
    while (!isOver()) drive();
    finish();
    return std::move(result_);
  }

 private:
  /// Lasers of short range see the same in very many places.
  static HypothesisTrackerParams trackerParams() {
    HypothesisTrackerParams params;
    params.max_hypotheses = 100;
    return params;
  }

  /// Scans, and decides what that means; plans if it goes on.
  bool isOver() {
    constexpr std::size_t kKept = 3;  // scans: what is beside the robot now, not what was
    scans_.insert(scans_.begin(), {world_.scan(truth_, noise_), odometry_});
    if (scans_.size() > kKept) scans_.pop_back();
    const TrackingState& state = tracker_.update(scans_.front().scan);
    ++result_.scans;
    looked_.push_back(odometry_);
    if (result_.scans == 1) {
      result_.first_scan = scans_.front().scan;
      result_.is_ambiguous_at_start = state.status != LocalizationStatus::unique;
    }
    result_.steps.push_back({truth_, state.hypotheses, {}, result_.travelled});
    if (state.status == LocalizationStatus::unique) {
      const bool is_right =
          isRight(state.hypotheses.front().pose_map_robot, truth_, params_.tolerance);
      result_.outcome = is_right ? TravelOutcome::localized : TravelOutcome::wrong;
      return true;
    }
    if (result_.scans >= params_.most_scans || result_.travelled >= params_.most_travel)
      return true;

    TravelPlan& plan = result_.steps.back().plan;
    plan = makePlan(state);
    result_.planning_ms.push_back(plan.planning_ms);
    if (plan.status == TravelStatus::indistinguishable) {
      result_.outcome = TravelOutcome::indistinguishable;
      return true;
    }
    // Someone in the way may be gone in the next scan.
    constexpr int kMostBlocked = 8;
    const bool moves = plan.status == TravelStatus::go &&
                       (plan.way.size() > 1 || std::abs(plan.waypoint.phi) > 2.0 * kDegree);
    blocked_ = moves ? 0 : blocked_ + 1;
    return blocked_ > kMostBlocked;
  }

  TravelPlan makePlan(const TrackingState& state) {
    TravelSituation situation;
    for (const TrackedHypothesis& tracked : state.hypotheses) {
      Hypothesis hypothesis;
      hypothesis.pose_map_robot = tracked.pose_map_robot;
      hypothesis.covariance = tracked.covariance;
      hypothesis.weight = tracked.weight;
      hypothesis.cost = tracked.cost;
      situation.hypotheses.push_back(hypothesis);
    }
    for (const PlacedScan& placed : scans_) {
      situation.scans.push_back({placed.scan, seenFrom(odometry_, placed.pose)});
    }
    for (const TPose2D& before : looked_) situation.looked.push_back(seenFrom(odometry_, before));
    situation.most_distance = params_.most_travel - result_.travelled;
    situation.seed = seed_ * 1000 + result_.scans;
    const bool knows_enough = state.status == LocalizationStatus::ambiguous;
    TravelPlan plan = knows_enough ? planner_.plan(situation) : planner_.explore(situation);
    if (plan.status != TravelStatus::decided) return plan;
    return planner_.explore(situation);
  }

  void drive() {
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
    odometry_ = compose(before, measured.pose_before_after);
  }

  /// One turn or straight piece, as it is measured; the truth goes astray.
  Motion move(const TPose2D& told) {
    const double length = std::hypot(told.x, told.y);
    const MotionNoise& with = params_.odometry;
    const double along = with.position_per_metre * length * noise_.normal();
    const double across = with.position_per_metre * length * noise_.normal();
    const double turn =
        (with.heading_per_metre * length + with.heading_per_radian * std::abs(told.phi)) *
        noise_.normal();
    const TPose2D start = truth_;
    const TPose2D end = compose(start, {told.x + along, told.y + across, told.phi + turn});
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

  void finish() {
    const std::vector<TrackedHypothesis>& left = tracker_.state().hypotheses;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    result_.error_m = result_.error_rad = nan;
    if (left.empty()) return;
    const TPose2D& first = left.front().pose_map_robot;
    result_.error_m = std::hypot(first.x - truth_.x, first.y - truth_.y);
    result_.error_rad = angleBetween(first.phi, truth_.phi);
  }

  const TravelPlanner& planner_;
  const World& world_;
  const TravelRunParams& params_;
  HypothesisTracker tracker_;
  Random noise_;
  std::uint64_t seed_;
  TPose2D truth_;
  TPose2D odometry_{0, 0, 0};      ///< as measured, from the start
  std::vector<PlacedScan> scans_;  ///< the last first, placed by odometry
  std::vector<TPose2D> looked_;    ///< by odometry
  int blocked_ = 0;
  TravelRunResult result_;
};

}  // namespace

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
  return Run(planner, localizer, world, start, params, seed).go();
}

}  // namespace mrpt_polyloc::apps
