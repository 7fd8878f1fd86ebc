#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>

namespace mrpt_polyloc {

/// What makes a scan hard, whatever method it is given to.
struct POLYLOC_EXPORT ScanTraits {
  double fov = 0.0;      ///< from the first to the last beam that says something [rad]
  std::size_t hits = 0;  ///< beams that hit something
  /// Share of the hits that end before what the map has there, seen from the true pose, by more
  /// than 0.3 m: people, furniture, doors.
  double clutter = 0.0;
  /// Share of the hits that pass a wall of the map by more than 0.3 m: glass, opened doors, errors
  /// of map or truth.
  double passed = 0.0;
  double outside = 0.0;  ///< distance of the true sensor place from the free space; 0 within [m]
};

/// Compares scans with a map from their true poses: quick to make, for it prepares little, and
/// linear in the map's edges for each scan. Const and thread-safe.
class POLYLOC_EXPORT ScanJudge {
 public:
  /// Keeps a reference to the map.
  explicit ScanJudge(const PolygonMap& map);

  ScanTraits traits(const RangeScan& scan, const mrpt::math::TPose2D& truth) const;

 private:
  const PolygonMap& map_;
  Triangulation triangulation_;
  RangePredictor predictor_;
};

}  // namespace mrpt_polyloc
