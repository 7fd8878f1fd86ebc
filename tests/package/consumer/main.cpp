// A user's first program: a map and a scan of it, localized and weighed as MRPT's metric map, from
// the installed headers and library alone.
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/io/observation.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>
#include <mrpt_polyloc/mrpt_bridge/registration.h>
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

/// Whether the metric map, which shares the localizer's index, likes the place where the scan was
/// taken more than others; and whether MRPT knows its class.
bool weighsTheScan(const mrpt_polyloc::MapIndex::Ptr& index, const TPose2D& truth) {
  mrpt_polyloc::registerClasses();
  if (mrpt::rtti::findRegisteredClass("mrpt_polyloc::CPolygonMap2D") == nullptr) return false;
  const auto scan =
      mrpt_polyloc::toObservation(simulateScan(index->map(), truth), 180 * 0.03, 0.0, 30.0);
  if (mrpt_polyloc::toRangeScan(scan).hitCount() != 181) return false;
  const mrpt_polyloc::CPolygonMap2D map(index);
  const std::vector<double> likelihoods = map.computeLikelihoods(
      scan, {truth, {truth.x + 0.5, truth.y, truth.phi}, {truth.x, truth.y, truth.phi + 0.3}});
  std::printf("log-likelihoods %.2f %.2f %.2f\n", likelihoods[0], likelihoods[1], likelihoods[2]);
  return likelihoods[0] > likelihoods[1] + 1.0 && likelihoods[0] > likelihoods[2] + 1.0;
}

bool near(const TPose2D& a, const TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < 0.05 && std::cos(a.phi - b.phi) > std::cos(0.02);
}

}  // namespace

int main() {
  const TPose2D truth(2.2, 5.1, 0.7);
  const auto index = mrpt_polyloc::MapIndex::build(room());
  const mrpt_polyloc::GlobalLocalizer localizer(index);
  const mrpt_polyloc::LocalizationResult result =
      localizer.localize(simulateScan(localizer.map(), truth));
  std::printf("mrpt_polyloc %s: %s, %zu hypotheses\n", mrpt_polyloc::kVersion,
              toString(result.status), result.hypotheses.size());
  if (result.hypotheses.empty()) return 1;
  const TPose2D& pose = result.hypotheses.front().pose_map_robot;
  std::printf("pose %.3f %.3f %.3f\n", pose.x, pose.y, pose.phi);
  return near(pose, truth) && weighsTheScan(index, truth) ? 0 : 1;
}
