#include <mrpt_polyloc/localization/scan/BeamEvidence.h>
#include <mrpt_polyloc/localization/scan/beam_evidence.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Nearer than this a point is on the wall [m]: the grid of distances is off by so much beside one,
/// and by less where a twin's walls happen to lie on its corners.
constexpr double kOnWall = 0.05;

}  // namespace

BeamEvidence::BeamEvidence(ScanCost cost, const BeamEvidenceParams& params)
    : cost_(std::move(cost)), params_(params) {
  using Place = std::pair<std::int64_t, std::int64_t>;
  std::map<Place, std::size_t> held;  // points of each square
  std::vector<Place> squares;
  for (std::size_t i = 0; i < cost_.beams().size(); ++i) {
    const Beam& beam = cost_.beams()[i];
    if (beam.kind != BeamKind::hit) continue;
    const double x = beam.range * std::cos(beam.bearing), y = beam.range * std::sin(beam.bearing);
    points_.push_back({i, x, y, 0.0});
    squares.emplace_back(std::llround(x / params.thinning), std::llround(y / params.thinning));
    ++held[squares.back()];
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    points_[i].weight = 1.0 / static_cast<double>(held[squares[i]] * held.size());
  }
}

/// Calls visit(point, nearness of it to a wall).
template <class Visitor>
void BeamEvidence::forEachPoint(const mrpt::math::TPose2D& pose, Visitor&& visit) const {
  const WallDistances& walls = cost_.predictor().wallDistances();
  const double cosine = std::cos(pose.phi), sine = std::sin(pose.phi);
  const double scale = -0.5 / (params_.wall_sigma * params_.wall_sigma);
  for (const Point& point : points_) {
    const double distance = walls.at(pose.x + cosine * point.x - sine * point.y,
                                     pose.y + sine * point.x + cosine * point.y);
    const double off = std::max(0.0, distance - kOnWall);
    visit(point, distance < WallDistances::kReach ? std::exp(scale * off * off) : 0.0);
  }
}

std::vector<float> BeamEvidence::at(const mrpt::math::TPose2D& pose) const {
  PredictedRanges predicted;
  cost_.predict(pose, predicted);
  std::vector<float> evidence = beamEvidence(cost_.beams(), predicted, params_);
  const double scale = params_.off_wall_cost * static_cast<double>(evidence.size());
  forEachPoint(pose, [&](const Point& point, double nearness) {
    evidence[point.beam] += static_cast<float>(scale * point.weight * (1.0 - nearness));
  });
  return evidence;
}

double BeamEvidence::nearness(const mrpt::math::TPose2D& pose) const {
  double sum = 0.0;
  forEachPoint(pose,
               [&sum](const Point& point, double nearness) { sum += point.weight * nearness; });
  return sum;
}

double meanOf(const std::vector<float>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace mrpt_polyloc
