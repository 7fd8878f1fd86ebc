// A user's first program: a map and a scan of it, from the installed headers and library alone.
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/version.h>

#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// An L-shaped room, 10 m by 8 m.
mrpt_polyloc::PolygonMap room() {
  return mrpt_polyloc::PolygonMap(
      {{mrpt_polyloc::wallRing({{0, 0}, {10, 0}, {10, 3}, {4, 3}, {4, 8}, {0, 8}}), {}}});
}

/// Range [m] from a point to the nearest wall in a direction of the map [rad].
double castRay(const mrpt_polyloc::PolygonMap& map, const TPoint2D& from, double direction) {
  const TPoint2D ray{std::cos(direction), std::sin(direction)};
  double nearest = std::numeric_limits<double>::infinity();
  for (const mrpt_polyloc::Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const TPoint2D& a = ring->vertices[i];
      const TPoint2D edge = ring->vertices[(i + 1) % ring->size()] - a;
      const TPoint2D to_a = a - from;
      const double denominator = ray.x * edge.y - ray.y * edge.x;
      const double range = (to_a.x * edge.y - to_a.y * edge.x) / denominator;
      const double along = (to_a.x * ray.y - to_a.y * ray.x) / denominator;
      if (range > 0 && along >= 0 && along <= 1) nearest = std::min(nearest, range);
    }
  }
  return nearest;
}

mrpt_polyloc::RangeScan simulateScan(const mrpt_polyloc::PolygonMap& map, const TPose2D& pose) {
  constexpr int kBeams = 181;
  constexpr double kSpacing = 0.03;  // [rad], over 5.4 rad
  std::vector<mrpt_polyloc::Beam> beams;
  for (int i = 0; i < kBeams; ++i) {
    const double bearing = kSpacing * (i - kBeams / 2);
    beams.push_back(
        {bearing, castRay(map, {pose.x, pose.y}, pose.phi + bearing), mrpt_polyloc::BeamKind::hit});
  }
  return mrpt_polyloc::RangeScan(std::move(beams));
}

/// Headers of the bridge need mrpt::obs, which the package must bring along.
std::size_t hitsOfObservation() {
  mrpt::obs::CObservation2DRangeScan observation;
  const float ranges[] = {1.0F, 2.0F, 3.0F};
  const char valid[] = {1, 1, 1};
  observation.loadFromVectors(3, ranges, valid);
  return mrpt_polyloc::toRangeScan(observation).hitCount();
}

bool near(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < 0.05 && std::cos(a.phi - b.phi) > std::cos(0.02);
}

}  // namespace

int main() {
  const TPose2D truth(2.2, 5.1, 0.7);
  const mrpt_polyloc::GlobalLocalizer localizer(room());
  const mrpt_polyloc::LocalizationResult result =
      localizer.localize(simulateScan(localizer.map(), truth));
  std::printf("mrpt_polyloc %s: %s, %zu hypotheses\n", mrpt_polyloc::kVersion,
              toString(result.status), result.hypotheses.size());
  if (result.hypotheses.empty()) return 1;
  const TPose2D& pose = result.hypotheses.front().pose_map_robot;
  std::printf("pose %.3f %.3f %.3f\n", pose.x, pose.y, pose.phi);
  return near(pose, truth) && hitsOfObservation() == 3 ? 0 : 1;
}
