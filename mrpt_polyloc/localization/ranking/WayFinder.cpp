#include <mrpt_polyloc/localization/ranking/WayFinder.h>
#include <mrpt_polyloc/localization/ranking/WheelDoubt.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Enough beams and steps to come near the optimum, from as far as wheels are off in one movement.
constexpr std::size_t kCoarseBeamsOfMoment = 60;

PoseRefinerParams nearEnough(PoseRefinerParams params) {
  params.step_tolerance = std::max(params.step_tolerance, 1e-3);  // [m]
  params.turn_tolerance = std::max(params.turn_tolerance, 3e-4);  // [rad]
  params.max_iterations *= 3;
  return params;
}

/// Of several ways to nearly one place the one against which scans and wheels together speak least.
class LeastDisputed {
 public:
  LeastDisputed(const SetEvidence& evidence, const HypothesisParams& params)
      : evidence_(&evidence), params_(&params) {}

  void offer(RefinedWay way) {
    const PairedDifference evidence = evidence_->level(evidence_->at(way.poses));
    // In units of how well the evidence of any way is known, not of a difference between two so
    // near each other: by that they would not be weighed as they are against ways elsewhere.
    if (!best_) unit_ = std::hypot(evidence.standard_error, params_->mapError());
    const double against =
        params_->calibration.weight_decay * evidence.mean / unit_ + 0.5 * way.tension;
    if (best_ && against >= least_) return;
    least_ = against;
    best_ = std::move(way);
  }

  const std::optional<RefinedWay>& best() const { return best_; }

 private:
  const SetEvidence* evidence_;
  const HypothesisParams* params_;
  std::optional<RefinedWay> best_;
  double least_ = 0.0, unit_ = 1.0;
};

}  // namespace

WayFinder::WayFinder(const RangePredictor& predictor, const ScanSet& set,
                     const MomentWeights& weights, const SetEvidence& evidence,
                     const Triangulation& triangulation, const PosePrior& prior,
                     const RankingParams& params)
    : set_(&set),
      evidence_(&evidence),
      params_(params.hypotheses),
      coarse_(predictor, set, weights, nearEnough(params.refinement), params.hypotheses.calibration,
              kCoarseBeamsOfMoment),
      fine_(predictor, set, weights, params.refinement, params.hypotheses.calibration) {
  for (const RangeScan& scan : set.now().scans) {
    allowed_.emplace_back(triangulation, prior, scan.sensor());
  }
}

bool WayFinder::isAllowed(const TPose2D& pose_map_robot) const {
  for (std::size_t i = 0; i < allowed_.size(); ++i) {
    const RangeScan& scan = set_->now().scans[i];
    if (!allowed_[i].contains(scan.beamFrameFromRobot(pose_map_robot))) return false;
  }
  return true;
}

std::optional<ScoredWay> WayFinder::byScans(const TPose2D& pose_map_robot, double worth) const {
  std::vector<TPose2D> way(set_->moments().size());
  TPose2D start = pose_map_robot;
  double cost = 0.0;
  for (std::size_t k = way.size(); k-- > 0;) {
    const bool is_now = k + 1 == way.size();
    const bool is_start_allowed = !is_now || isAllowed(start);
    way[k] = start;
    double of_moment = evidence_->cost(k, start);
    if (!is_start_allowed || cost <= worth) {
      const TPose2D end = coarse_.refineAlone(k, start);
      const bool is_end_allowed = !is_now || isAllowed(end);
      if (!is_start_allowed && !is_end_allowed) return std::nullopt;
      const double at_end = evidence_->cost(k, end);
      if (is_end_allowed && (!is_start_allowed || at_end <= of_moment)) {
        way[k] = end;
        of_moment = at_end;
      }
    }
    cost += evidence_->weight(k) * of_moment;
    if (k == 0) break;
    start = way[k] + inverse(set_->moments()[k].since_before).pose_before_after;
    start.normalizePhi();
  }
  return ScoredWay{coarse_.at(way), cost, pose_map_robot};
}

double WayFinder::worth(double least_cost) {
  constexpr double kWorthShare = 1.25, kWorthMargin = 0.03;  // as for one scan, [m]
  return kWorthShare * least_cost + kWorthMargin;
}

std::size_t WayFinder::worthCount(const std::vector<ScoredWay>& ways) {
  std::size_t count = 0;
  while (count < ways.size() && ways[count].cost <= worth(ways.front().cost)) ++count;
  return count;
}

double WayFinder::wheelScale(const std::vector<ScoredWay>& ways) const {
  constexpr std::size_t kMostWays = 10;
  const std::size_t count = std::min(worthCount(ways), kMostWays);
  std::vector<SetEvidence::Values> values;
  std::size_t best = 0;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(evidence_->at(ways[i].refined.poses));
    if (evidence_->mean(values[i]) < evidence_->mean(values[best])) best = i;
  }
  double least = 0.0, scale = 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double behind =
        standardErrors(evidence_->difference(values[best], values[i]), params_.mapError());
    const WheelDoubt doubt = doubtWheels(coarse_.movementErrors(ways[i].refined.poses));
    const double against = params_.calibration.weight_decay * std::max(0.0, behind) + doubt.against;
    if (i > 0 && against >= least) continue;
    least = against;
    scale = doubt.scale;
  }
  return scale;
}

ScoredWay WayFinder::likeliest(const ScoredWay& by_scans, double wheel_scale,
                               bool may_be_best) const {
  const SetRefiner& refiner = may_be_best ? fine_ : coarse_;
  const std::vector<TPose2D>& poses = by_scans.refined.poses;
  LeastDisputed ways(*evidence_, params_);
  ways.offer(refiner.at(poses, wheel_scale));
  if (isAllowed(by_scans.start)) {
    ways.offer(refiner.at(refiner.wayTo(by_scans.start), wheel_scale));
  }
  if (may_be_best) {
    RefinedWay refined = refiner.refine(poses, wheel_scale);
    if (isAllowed(refined.poses.back())) ways.offer(std::move(refined));
  }
  return ScoredWay{*ways.best(), evidence_->cost(ways.best()->poses), by_scans.start};
}

}  // namespace mrpt_polyloc
