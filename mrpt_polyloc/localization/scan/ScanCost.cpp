#include <mrpt_polyloc/localization/scan/ScanCost.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace mrpt_polyloc {
namespace {

std::vector<Beam> informativeBeams(const RangeScan& scan) {
  std::vector<Beam> beams;
  std::copy_if(scan.beams().begin(), scan.beams().end(), std::back_inserter(beams),
               [](const Beam& beam) { return beam.kind != BeamKind::invalid; });
  return beams;
}

std::vector<double> bearingsOf(const std::vector<Beam>& beams) {
  std::vector<double> bearings(beams.size());
  std::transform(beams.begin(), beams.end(), bearings.begin(),
                 [](const Beam& beam) { return beam.bearing; });
  return bearings;
}

}  // namespace

ScanCost::ScanCost(const RangePredictor& predictor, const RangeScan& scan,
                   const RobustCostParams& params)
    : predictor_(&predictor),
      cost_(params),
      beams_(informativeBeams(scan)),
      pattern_(bearingsOf(beams_)) {}

std::vector<float> ScanCost::perBeam(const mrpt::math::TPose2D& pose_map_beams) const {
  PredictedRanges predicted;
  predictor_->predict(pose_map_beams, pattern_, predicted);
  std::vector<float> costs(beams_.size());
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    costs[i] = cost_(beams_[i], predicted.wall[i], predicted.open[i]);
  }
  return costs;
}

double ScanCost::mean(const mrpt::math::TPose2D& pose_map_beams) const {
  const std::vector<float> costs = perBeam(pose_map_beams);
  if (costs.empty()) return 0.0;
  return std::accumulate(costs.begin(), costs.end(), 0.0) / static_cast<double>(costs.size());
}

double ScanCost::polarDistance(const mrpt::math::TPose2D& pose_map_beams) const {
  PredictedRanges predicted;
  predict(pose_map_beams, predicted);
  double sum = 0.0;
  std::size_t hits = 0;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    if (beams_[i].kind != BeamKind::hit) continue;
    const double wall = std::min(static_cast<double>(predicted.wall[i]), kReach);
    const double off = wall - std::min(beams_[i].range, kReach);
    sum += off * off;
    ++hits;
  }
  return hits > 0 ? std::sqrt(sum / static_cast<double>(hits)) : 0.0;
}

}  // namespace mrpt_polyloc
