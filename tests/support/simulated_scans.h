#pragma once

#include "tests/support/BruteForceRays.h"
#include "tests/support/map_factories.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <cmath>
#include <random>
#include <vector>

/// Scans of known poses, by brute force.
namespace mrpt_polyloc::test {

/// What of a simulated scan is not an all-round, noise-free one of a sensor at the robot's origin.
struct ScanOptions {
  std::size_t beams = 360;
  double field_of_view = kTwoPi;
  double max_range = 80.0;
  TPoint2D sensor{0, 0};
  double sigma = 0.0;        ///< of the ranges [m]
  double short_share = 0.0;  ///< of the beams, which end anywhere before the wall
  std::uint32_t seed = 1;
};

/// The scan of a robot at the given pose. Beams that meet nothing within max_range are no-returns.
inline RangeScan simulatedScan(const PolygonMap& map, const mrpt::math::TPose2D& pose_map_robot,
                               const ScanOptions& options = {}) {
  const BruteForceRays rays(map);
  std::mt19937 random(options.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto origin = RangeScan({}, options.sensor).beamFrameFromRobot(pose_map_robot);
  std::vector<Beam> beams(options.beams);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(beams.size());
    Beam& beam = beams[i];
    beam.bearing = options.field_of_view * (share - 0.5);
    const double wall = rays.cast({origin.x, origin.y}, origin.phi + beam.bearing).wall;
    beam.range = wall + options.sigma * noise(random);
    if (unit(random) < options.short_share) beam.range *= unit(random);
    beam.kind = BeamKind::hit;
    if (!(wall < options.max_range)) beam = {beam.bearing, options.max_range, BeamKind::no_return};
  }
  return RangeScan(std::move(beams), options.sensor);
}

inline double distanceBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

inline double turnBetween(const mrpt::math::TPose2D& a, const mrpt::math::TPose2D& b) {
  return std::abs(std::remainder(a.phi - b.phi, kTwoPi));
}

/// A room without symmetry: every corner and wall is told from the others.
inline PolygonMap asymmetricRoom() {
  return mapOf({{0, 0}, {7, 0}, {7, 2}, {5.5, 2}, {5.5, 5}, {2, 6}, {2, 4}, {0, 4}},
               {{{3, 2}, {3.5, 2}, {3.5, 2.8}, {3, 2.8}}});
}

}  // namespace mrpt_polyloc::test
