#pragma once

// What the tests of CPolygonMap2D look at: small maps, and scans in them.

#include "tests/support/map_factories.h"
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/geometry/validation.h>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>

namespace mrpt_polyloc::test {

/// What is seen of a map from a pose of the robot, by casting rays one by one.
inline mrpt::obs::CObservation2DRangeScan castScan(const PolygonMap& map, double x, double y,
                                                   double phi) {
  const WallSegments walls(map);
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = 3.0F;
  scan.maxRange = 80.0F;
  scan.sensorPose = mrpt::poses::CPose3D(0.3, 0.1, 0, 0.2, 0, 0);
  scan.resizeScanAndAssign(61, 1.0F, true);
  const mrpt::poses::CPose3D sensor = mrpt::poses::CPose3D(x, y, 0, phi, 0, 0) + scan.sensorPose;
  for (std::size_t i = 0; i < 61; ++i) {
    const double direction = sensor.yaw() - 1.5 + 0.05 * static_cast<double>(i);
    scan.setScanRange(i, static_cast<float>(walls.range({sensor.x(), sensor.y()}, direction)));
  }
  return scan;
}

inline PolygonMap room() {
  return mapOf({{0, 0}, {10, 0}, {10, 3}, {4, 3}, {4, 8}, {0, 8}});
}

/// An open edge, a wall beyond it, and a hole.
inline PolygonMap partlyOpenRoom() {
  RawMap raw;
  raw.polygons.push_back(
      {wallRing({{0, 0}, {10, 0}, {10, 6}, {0, 6}}), {wallRing({{4, 2}, {4, 4}, {5, 4}, {5, 2}})}});
  raw.polygons.front().outer.kinds[1] = EdgeKind::open;
  raw.walls_beyond.push_back({{12, 1}, {12, 3}, {13, 5}});
  return repairMap(raw).map;
}

}  // namespace mrpt_polyloc::test
