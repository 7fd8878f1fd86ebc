#pragma once

#include <mrpt_polyloc/base/Random.h>
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/vectors.h>
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/travel/Sight.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace mrpt_polyloc::test {

/// A scan as the independent ray caster sees it: beams all around, or over a field of view.
inline RangeScan castScan(const WallSegments& walls, const mrpt::math::TPose2D& pose,
                          std::size_t beams = 360, double max_range = 30.0,
                          double fov = 2.0 * kPi) {
  std::vector<Beam> read;
  for (std::size_t i = 0; i < beams; ++i) {
    const double bearing = -0.5 * fov + fov * static_cast<double>(i) / static_cast<double>(beams);
    const double range = walls.range({pose.x, pose.y}, pose.phi + bearing);
    const bool is_hit = range < max_range;
    read.push_back(
        {bearing, is_hit ? range : max_range, is_hit ? BeamKind::hit : BeamKind::no_return});
  }
  return RangeScan(std::move(read));
}

inline Hypothesis hypothesisAt(double x, double y, double phi, double weight,
                               double deviation = 0.01) {
  Hypothesis hypothesis;
  hypothesis.pose_map_robot = {x, y, phi};
  hypothesis.covariance = mrpt::math::CMatrixDouble33::Zero();
  hypothesis.covariance(0, 0) = hypothesis.covariance(1, 1) = deviation * deviation;
  hypothesis.covariance(2, 2) = 1e-5;
  hypothesis.weight = weight;
  return hypothesis;
}

/// A point of a hypothesis's frame in the map.
inline TPoint2D inMap(const Hypothesis& hypothesis, const TPoint2D& p) {
  const mrpt::math::TPose2D& pose = hypothesis.pose_map_robot;
  const double c = std::cos(pose.phi), s = std::sin(pose.phi);
  return {pose.x + c * p.x - s * p.y, pose.y + s * p.x + c * p.y};
}

/// Distance to the border of free space, open edges included; negative outside.
inline double signedClearance(const PolygonMap& map, const TPoint2D& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ring* ring : map.rings()) {
    for (std::size_t i = 0; i < ring->size(); ++i) {
      least = std::min(
          least, distanceToSegment(p, ring->vertices[i], ring->vertices[(i + 1) % ring->size()]));
    }
  }
  return map.contains(p) ? least : -least;
}

}  // namespace mrpt_polyloc::test
