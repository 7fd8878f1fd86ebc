#pragma once

#include "tests/support/BruteForceRays.h"
#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <cmath>
#include <vector>

/// Noise-free views as the exact queries take them, and what they answer.
namespace mrpt_polyloc::test {

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

/// Whether a pose is among the hypotheses, within a tenth of a millimetre.
inline bool holds(const LocalizationResult& result, const mrpt::math::TPose2D& pose) {
  for (const Hypothesis& h : result.hypotheses) {
    const auto& p = h.pose_map_robot;
    if (std::hypot(p.x - pose.x, p.y - pose.y) < 1e-4 && angleBetween(p.phi, pose.phi) < 1e-4)
      return true;
  }
  return false;
}

/// Whether rays from p in the map are as long as rays from the origin in the polygon, but for a few
/// that graze a vertex. So many rays, for far teeth of a comb are seen in sectors below a degree.
inline bool looksAlike(const BruteForceRays& map, const mrpt::math::TPose2D& pose,
                       const BruteForceRays& view) {
  int different = 0;
  for (int i = 0; i < 4000 && different <= 4; ++i) {
    const double angle = 0.0123 + kTwoPi * i / 4000;
    const double in_map = map.cast({pose.x, pose.y}, angle + pose.phi).wall;
    different += std::abs(in_map - view.cast({0, 0}, angle).wall) > 1e-4 ? 1 : 0;
  }
  return different <= 4;
}

}  // namespace mrpt_polyloc::test
