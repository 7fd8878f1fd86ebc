#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/MapIndexParts.h>
#include <mrpt_polyloc/localization/inspection/scan_comparison.h>
#include <mrpt_polyloc/localization/nearest_cells/scan_view.h>
#include <mrpt_polyloc/localization/scan/RobustCost.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

constexpr std::size_t kSamples = SampledPolarFunction::kDefaultSamples;

std::optional<ScanComparison::Polar> polarOf(const RangePredictor& predictor, const RangeScan& scan,
                                             const TPose2D& pose_map_beams) {
  ScanViewParams params;
  params.samples = kSamples;
  const std::optional<ScanView> measured = viewOfScan(scan, params);
  if (!measured) return std::nullopt;
  std::vector<double> bearings(kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    bearings[i] = kTwoPi * static_cast<double>(i) / static_cast<double>(kSamples);
  }
  PredictedRanges ranges;
  predictor.predict(pose_map_beams, BeamPattern(bearings), ranges);
  const auto reach = static_cast<float>(std::min(measured->reach, params.range));
  for (float& range : ranges.wall) range = std::min(range, reach);
  const SampledPolarFunction predicted(std::move(ranges.wall));
  const RotationMatch best = distanceOverRotations(measured->samples, predicted);
  return ScanComparison::Polar{distance(measured->samples, predicted), best.distance,
                               std::remainder(best.rotation, kTwoPi)};
}

}  // namespace

ScanComparison compareWithMap(const MapIndex& index, const RangeScan& scan,
                              const TPose2D& pose_map_robot, const RobustCostParams& params) {
  if (!std::isfinite(pose_map_robot.x + pose_map_robot.y + pose_map_robot.phi)) {
    throw InvalidParamsError("pose: not finite");
  }
  params.check();
  const RangePredictor& predictor = index.parts().predictor();
  const TPose2D pose_map_beams = scan.beamFrameFromRobot(pose_map_robot);
  std::vector<double> bearings;
  for (const Beam& beam : scan.beams()) bearings.push_back(beam.bearing);
  PredictedRanges ranges;
  predictor.predict(pose_map_beams, BeamPattern(bearings), ranges);

  ScanComparison comparison;
  comparison.wall = std::move(ranges.wall);
  comparison.open = std::move(ranges.open);
  const RobustCost cost(params);
  double sum = 0.0;
  std::size_t informative = 0;
  for (std::size_t i = 0; i < scan.beams().size(); ++i) {
    const Beam& beam = scan.beams()[i];
    if (beam.kind == BeamKind::invalid) {  // a scan does not keep where they look
      comparison.wall[i] = comparison.open[i] = std::numeric_limits<float>::infinity();
    }
    comparison.cost.push_back(cost(beam, comparison.wall[i], comparison.open[i]));
    if (beam.kind == BeamKind::invalid) continue;
    sum += comparison.cost.back();
    ++informative;
  }
  if (informative > 0) comparison.mean_cost = sum / static_cast<double>(informative);
  comparison.polar = polarOf(predictor, scan, pose_map_beams);
  return comparison;
}

}  // namespace mrpt_polyloc
