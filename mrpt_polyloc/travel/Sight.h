#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <vector>

namespace mrpt_polyloc {

/// A scan, and where the robot was when it was taken, in the frame that is asked about.
struct POLYLOC_EXPORT PlacedScan {
  RangeScan scan;
  mrpt::math::TPose2D pose;  ///< of the robot [m, rad]
};

/// What scans have seen free and where they hit, in one frame: what a robot knows of its
/// surroundings whatever map it is in.
///
/// Up to each hit, and up to the sensor's maximum along a no-return, nothing stands; beams that say
/// nothing have seen nothing, nor is anything known between beams far apart. What an older scan hit
/// is gone where the newest sees through, or the robot stands: wheels misplace older scans, and a
/// door post that stands in the door closes it; people walk on. (A no-return may be
/// glass: it counts as free here, as it does for the robot's own obstacle avoidance. Beams between
/// two neighbours are not known of, so only discs are asked about.)
class POLYLOC_EXPORT Sight {
 public:
  /// \param scans the newest first
  /// \param own_radius the robot stood in each place: so much around it is free [m]
  explicit Sight(const std::vector<PlacedScan>& scans, double own_radius);

  /// Whether one scan has seen the whole disc free.
  bool seesDisc(const mrpt::math::TPoint2D& centre, double radius) const;

  const std::vector<mrpt::math::TPoint2D>& hits() const { return hits_; }

 private:
  struct Rays {
    mrpt::math::TPose2D pose;      ///< of the beam frame
    std::vector<double> bearings;  ///< ascending, in (-pi, pi]
    std::vector<double> ranges;    ///< free up to here [m]
  };
  static bool sees(const Rays& rays, const mrpt::math::TPoint2D& centre, double radius);
  static bool seesThrough(const Rays& rays, const mrpt::math::TPoint2D& hit);

  std::vector<Rays> rays_;
  std::vector<mrpt::math::TPoint2D> hits_;
};

}  // namespace mrpt_polyloc
