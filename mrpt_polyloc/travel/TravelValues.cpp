#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/travel/SafeSet.h>
#include <mrpt_polyloc/travel/TravelValues.h>

#include <algorithm>
#include <numeric>

namespace mrpt_polyloc {
namespace {

/// From this on turning shows nothing new worth the scan.
constexpr double kAllAround = 300.0 * kDegree;

}  // namespace

TravelValues::TravelValues(const RangePredictor& predictor, const ClearanceField& field,
                           const std::vector<Hypothesis>& hypotheses, const LaserModel& laser,
                           const TravelPlannerParams& params)
    : field_(&field),
      hypotheses_(&hypotheses),
      params_(params),
      expectation_(predictor, laser, params.readings),
      evidence_(laser, params.evidence),
      sees_all_around_(laser.fieldOfView() >= kAllAround) {
  double all = 0.0;
  for (const Hypothesis& hypothesis : hypotheses) all += hypothesis.weight;
  std::vector<std::size_t> order(hypotheses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return hypotheses[a].weight > hypotheses[b].weight;
  });
  for (const std::size_t i : order) {
    if (hypotheses[i].weight < params.least_weight * all) break;
    compares_all_ = compared_.size() < params.most_hypotheses;
    if (!compares_all_) break;
    compared_.push_back(i);
  }
  for (std::size_t a = 0; a < compared_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      all_pairs_ += hypotheses[compared_[a]].weight * hypotheses[compared_[b]].weight;
    }
  }
}

TravelValues::Value TravelValues::at(const mrpt::math::TPose2D& pose) const {
  Value value;
  value.pose = pose;
  value.falls.assign(hypotheses_->size(), 0.0);
  std::vector<ExpectedReadings> readings(compared_.size());
  // In the map of a hypothesis that has a wall here nothing can be expected; coming near tells.
  std::vector<bool> is_free(compared_.size());
  for (std::size_t a = 0; a < compared_.size(); ++a) {
    const Hypothesis& hypothesis = (*hypotheses_)[compared_[a]];
    is_free[a] = clearanceAt(*field_, hypothesis.pose_map_robot, {pose.x, pose.y}) > 0.0;
    if (is_free[a]) readings[a] = expectation_.at(hypothesis, pose);
  }
  double told = 0.0;
  for (std::size_t a = 0; a < compared_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double tells = is_free[a] == is_free[b] ? 0.0 : 1.0;
      if (is_free[a] && is_free[b]) tells = evidence_.tells(readings[a], readings[b]);
      if (tells < params_.least_telling) continue;
      const double weight_a = (*hypotheses_)[compared_[a]].weight;
      const double weight_b = (*hypotheses_)[compared_[b]].weight;
      told += tells * weight_a * weight_b;
      value.falls[compared_[a]] += tells * weight_b;
      value.falls[compared_[b]] += tells * weight_a;
    }
  }
  value.told = all_pairs_ > 0.0 ? told / all_pairs_ : 0.0;
  return value;
}

TravelValues::Value TravelValues::at(const TPoint2D& place, double heading) const {
  Value best = at(mrpt::math::TPose2D(place.x, place.y, heading));
  if (sees_all_around_) return best;
  for (int quarter = 1; quarter < 4; ++quarter) {
    const double turned = std::remainder(heading + quarter * 0.5 * kPi, kTwoPi);
    Value other = at(mrpt::math::TPose2D(place.x, place.y, turned));
    if (other.told > best.told) best = std::move(other);
  }
  return best;
}

}  // namespace mrpt_polyloc
