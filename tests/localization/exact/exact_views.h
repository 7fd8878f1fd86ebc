#pragma once

#include "tests/support/BruteForceRays.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/exact/ExactAnswers.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// Noise-free views as the exact queries take them, and what they answer.
namespace mrpt_polyloc::test {

/// What the exact queries are asked with in these tests [m].
constexpr double kExactTolerance = 1e-6;

/// What is seen from a pose, in the robot's frame.
inline std::vector<TPoint2D> seenFrom(const PolygonMap& map, const mrpt::math::TPose2D& pose) {
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation, true);
  auto polygon = visibilityPolygon(triangulation, expander.expand({pose.x, pose.y}));
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  for (TPoint2D& v : polygon) {
    const TPoint2D d(v.x - pose.x, v.y - pose.y);
    v = {c * d.x + s * d.y, c * d.y - s * d.x};
  }
  return polygon;
}

/// Whether a pose is among the answers, within a tenth of a millimetre.
inline bool holds(const ExactAnswers& answers, const mrpt::math::TPose2D& pose) {
  for (const mrpt::math::TPose2D& p : answers.poses) {
    if (std::hypot(p.x - pose.x, p.y - pose.y) < 1e-4 && angleBetween(p.phi, pose.phi) < 1e-4)
      return true;
  }
  return false;
}

/// Directions relative to a robot: all around, and beside each vertex of a map, where what is seen
/// changes if it does at all, be it in a sector of a thousandth of a degree.
inline std::vector<double> directionsFrom(const PolygonMap& map, const mrpt::math::TPose2D& pose) {
  std::vector<double> angles;
  for (int i = 0; i < 120; ++i) angles.push_back(0.0123 + kTwoPi * i / 120);
  for (const Ring* ring : map.rings()) {
    for (const TPoint2D& v : ring->vertices) {
      const double angle = std::atan2(v.y - pose.y, v.x - pose.x) - pose.phi;
      angles.insert(angles.end(), {angle - 1e-5, angle + 1e-5});
    }
  }
  return angles;
}

/// A map for rays by brute force.
struct RayMap {
  explicit RayMap(PolygonMap m) : map(std::move(m)), rays(map) {}
  /// A view as a room around the origin.
  explicit RayMap(std::vector<TPoint2D> view)
      : RayMap(PolygonMap({{wallRing(std::move(view)), {}}})) {}
  PolygonMap map;
  BruteForceRays rays;
};

/// How many rays from a pose in one map are not as long, within a range, as those from a pose in
/// another one, by more than a tenth of a millimetre; counted up to `enough`.
inline std::size_t countDifferent(const RayMap& a, const mrpt::math::TPose2D& pose_a,
                                  const RayMap& b, const mrpt::math::TPose2D& pose_b, double range,
                                  std::size_t enough) {
  std::vector<double> angles = directionsFrom(a.map, pose_a);
  const std::vector<double> more = directionsFrom(b.map, pose_b);
  angles.insert(angles.end(), more.begin(), more.end());
  const auto cut = [&](const RayMap& map, const mrpt::math::TPose2D& pose, double angle) {
    const RayHit hit = map.rays.cast({pose.x, pose.y}, angle + pose.phi);
    return std::min({hit.wall, hit.open, range});
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < angles.size() && count < enough; ++i) {
    count += std::abs(cut(a, pose_a, angles[i]) - cut(b, pose_b, angles[i])) > 1e-4 ? 1 : 0;
  }
  return count;
}

/// Whether just this polygon is seen from a pose.
inline bool looksAlike(const RayMap& map, const mrpt::math::TPose2D& pose, const RayMap& view) {
  return countDifferent(map, pose, view, {0, 0, 0}, 1e9, 1) == 0;
}

}  // namespace mrpt_polyloc::test
