// A user's first program: a map and a scan of it, from the installed headers and library alone.
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/localization/RangeScan.h>
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

}  // namespace

int main() {
  const mrpt_polyloc::PolygonMap map = room();
  const mrpt_polyloc::RangeScan scan = simulateScan(map, TPose2D(2.2, 5.1, 0.7));
  std::printf("mrpt_polyloc %s: %.1f m2, %zu hits\n", mrpt_polyloc::kVersion, map.area(),
              scan.hitCount());
  return std::abs(map.area() - 50.0) < 1e-9 && scan.hitCount() == 181 ? 0 : 1;
}
