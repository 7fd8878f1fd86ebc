#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/travel/ExpectedReadings.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Positions within a band are looked at so closely [m].
constexpr double kReadingStep = 0.1;
/// Below this a band is not widened by looking: the tolerance covers it [m].
constexpr double kLeastSpread = 0.03;

struct Spread {
  double deviation;  ///< [m]
  double direction;  ///< [rad]
};

/// The widest direction of a position's covariance.
Spread widest(const Hypothesis& hypothesis) {
  const double a = hypothesis.covariance(0, 0), b = hypothesis.covariance(0, 1),
               d = hypothesis.covariance(1, 1);
  const double variance = 0.5 * (a + d) + std::hypot(0.5 * (a - d), b);
  return {std::sqrt(std::max(0.0, variance)), 0.5 * std::atan2(2.0 * b, a - d)};
}

std::vector<std::size_t> byBearing(const std::vector<double>& bearings) {
  std::vector<std::size_t> order(bearings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return wrapToTwoPi(bearings[a]) < wrapToTwoPi(bearings[b]);
  });
  return order;
}

}  // namespace

LaserModel LaserModel::of(const RangeScan& scan, std::size_t most_beams, double max_range) {
  LaserModel laser;
  laser.sensor = scan.sensor();
  const std::size_t count = scan.beams().size();
  const std::size_t kept = std::min(count, std::max<std::size_t>(1, most_beams));
  for (std::size_t i = 0; i < kept; ++i) {
    laser.bearings.push_back(scan.beams()[i * count / kept].bearing);
  }
  double farthest = 0.0, none = 0.0;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind == BeamKind::hit) farthest = std::max(farthest, beam.range);
    if (beam.kind == BeamKind::no_return) none = std::max(none, beam.range);
  }
  laser.max_range = max_range > 0.0 ? max_range : (none > 0.0 ? none : farthest);
  return laser;
}

double LaserModel::fieldOfView() const {
  if (bearings.empty()) return 0.0;
  const std::vector<std::size_t> order = byBearing(bearings);
  double widest_gap = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double here = wrapToTwoPi(bearings[order[i]]);
    const double next = i + 1 < order.size() ? wrapToTwoPi(bearings[order[i + 1]])
                                             : wrapToTwoPi(bearings[order[0]]) + kTwoPi;
    widest_gap = std::max(widest_gap, next - here);
  }
  return kTwoPi - widest_gap;
}

void ExpectedReadingsParams::check() const {
  requireNotNegative("tolerance", tolerance);
  requireNotNegative("deviations", deviations);
  requireNotNegative("most_deviation", most_deviation);
}

ReadingExpectation::ReadingExpectation(const RangePredictor& predictor, const LaserModel& laser,
                                       const ExpectedReadingsParams& params)
    : predictor_(&predictor), laser_(laser), params_(params), pattern_(laser.bearings) {
  params.check();
  requirePositive("max_range", laser.max_range);
  // Headings are as uncertain as beams are apart: a band takes in its neighbours'.
  constexpr double kWidest = 6.0 * kDegree;
  const std::vector<std::size_t> order = byBearing(laser.bearings);
  next_.resize(order.size());
  previous_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t here = order[k], after = order[(k + 1) % order.size()];
    const bool is_near = angleBetween(laser.bearings[here], laser.bearings[after]) <= kWidest;
    next_[here] = is_near ? after : here;
    previous_[after] = is_near ? here : after;
  }
}

ExpectedReadings ReadingExpectation::at(const Hypothesis& hypothesis, const TPose2D& moved) const {
  const TPose2D& now = hypothesis.pose_map_robot;
  const double c = std::cos(now.phi), s = std::sin(now.phi), heading = now.phi + moved.phi;
  const double x = now.x + c * moved.x - s * moved.y, y = now.y + s * moved.x + c * moved.y;
  const double ch = std::cos(heading), sh = std::sin(heading);
  const TPose2D beams(x + ch * laser_.sensor.x - sh * laser_.sensor.y,
                      y + sh * laser_.sensor.x + ch * laser_.sensor.y, heading);

  const Spread spread = widest(hypothesis);
  const double reach = std::min(params_.deviations * spread.deviation, params_.most_deviation);
  std::vector<TPose2D> poses{beams};
  if (reach > kLeastSpread) {
    const auto steps = static_cast<int>(std::ceil(reach / kReadingStep));
    for (int k = -steps; k <= steps; ++k) {
      const double off = reach * k / steps;
      if (k == 0) continue;
      poses.emplace_back(beams.x + off * std::cos(spread.direction),
                         beams.y + off * std::sin(spread.direction), heading);
    }
  }
  PredictedRanges predicted;
  predictor_->predict(poses, pattern_, predicted);

  const std::size_t count = laser_.bearings.size();
  ExpectedReadings narrow, readings;
  narrow.low.assign(predicted.wall.begin(),
                    predicted.wall.begin() + static_cast<std::ptrdiff_t>(count));
  narrow.high = narrow.low;
  for (std::size_t pose = 0; pose < poses.size(); ++pose) {
    for (std::size_t i = 0; i < count; ++i) {
      const float wall = predicted.wall[pose * count + i], open = predicted.open[pose * count + i];
      narrow.low[i] = std::min(narrow.low[i], std::min(wall, open));
      narrow.high[i] = std::max(narrow.high[i], wall);
    }
  }
  readings.low.resize(count);
  readings.high.resize(count);
  const auto tolerance = static_cast<float>(params_.tolerance);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = previous_[i], b = next_[i];
    readings.low[i] = std::min({narrow.low[a], narrow.low[i], narrow.low[b]}) - tolerance;
    readings.high[i] = std::max({narrow.high[a], narrow.high[i], narrow.high[b]}) + tolerance;
  }
  return readings;
}

}  // namespace mrpt_polyloc
