#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/ScanTraits.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr double kClear = 0.3;  // [m]: the tolerance of a right pose, and more than noise

/// The widest span of bearings that say something: the circle without its largest gap.
double spanOf(std::vector<double> bearings) {
  if (bearings.size() < 2) return 0.0;
  for (double& bearing : bearings) bearing = wrapToTwoPi(bearing);
  std::sort(bearings.begin(), bearings.end());
  double gap = bearings.front() + kTwoPi - bearings.back();
  for (std::size_t i = 1; i < bearings.size(); ++i) {
    gap = std::max(gap, bearings[i] - bearings[i - 1]);
  }
  return kTwoPi - gap;
}

double distanceToFreeSpace(const PolygonMap& map, const TPoint2D& point) {
  if (map.contains(point)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      nearest = std::min(nearest, distanceToSegment(point, ring->vertices[i],
                                                    ring->vertices[(i + 1) % ring->size()]));
    }
  }
  return nearest;
}

/// No lists of what is seen from where: a scan has one true pose, and to find it among all edges
/// costs less than lists for the whole map.
VisibleEdgeIndex::Lists noLists(const Triangulation& triangulation) {
  VisibleEdgeIndex::Lists lists;
  lists.square_size = RangePredictor::kSquareSize;
  lists.horizon = VisibleEdgeIndex::kHorizon;
  lists.layout = BoundaryChains(triangulation).hash();
  lists.begin = {0};
  return lists;
}

}  // namespace

ScanJudge::ScanJudge(const PolygonMap& map)
    : map_(map), triangulation_(map), predictor_(triangulation_, noLists(triangulation_)) {}

ScanTraits ScanJudge::traits(const RangeScan& scan, const mrpt::math::TPose2D& truth) const {
  const mrpt::math::TPose2D eye = scan.beamFrameFromRobot(truth);
  ScanTraits traits;
  traits.hits = scan.hitCount();
  traits.outside = distanceToFreeSpace(map_, {eye.x, eye.y});
  std::vector<double> bearings, telling, ranges;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind == BeamKind::invalid) continue;
    telling.push_back(beam.bearing);
    if (beam.kind != BeamKind::hit) continue;
    bearings.push_back(beam.bearing);
    ranges.push_back(beam.range);
  }
  traits.fov = spanOf(std::move(telling));
  if (ranges.empty()) return traits;
  PredictedRanges predicted;
  predictor_.predict(eye, BeamPattern(bearings), predicted);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double wall = static_cast<double>(predicted.wall[i]);
    const double open = static_cast<double>(predicted.open[i]);
    traits.clutter += ranges[i] < std::min(wall, open) - kClear ? 1.0 : 0.0;
    traits.passed += ranges[i] > wall + kClear ? 1.0 : 0.0;
  }
  traits.clutter /= static_cast<double>(ranges.size());
  traits.passed /= static_cast<double>(ranges.size());
  return traits;
}

}  // namespace mrpt_polyloc
