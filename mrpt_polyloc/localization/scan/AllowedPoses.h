#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// Where the beam frame of a scan (see RangeScan) may be: the robot where the prior allows, the
/// sensor in free space, or beside it in unknown space that no wall cuts off. What no answer
/// leaves.
class AllowedPoses {
 public:
  /// How far beside free space a sensor may be [m]: a third of the misses on real maps were robots
  /// in holes and ragged borders of the traced space, most of them this near to it.
  static constexpr double kBeside = 0.7;

  /// Keeps references. \param sensor the beams' origin in the robot frame [m]
  AllowedPoses(const Triangulation& triangulation, const PosePrior& prior,
               const mrpt::math::TPoint2D& sensor, double beside = kBeside)
      : triangulation_(&triangulation), prior_(&prior), sensor_(sensor), beside_(beside) {}

  /// Up to rounding.
  bool contains(const mrpt::math::TPose2D& pose_map_beams) const;

  /// A pose moved as little as the prior demands: the heading into its interval, then the robot
  /// into its disk. Free space is not looked at.
  mrpt::math::TPose2D nearest(const mrpt::math::TPose2D& pose_map_beams) const;

  /// The last pose allowed, to a millimetre, on the way from one that is to another.
  mrpt::math::TPose2D lastOnTheWay(const mrpt::math::TPose2D& from,
                                   const mrpt::math::TPose2D& to) const;

 private:
  const Triangulation* triangulation_;
  const PosePrior* prior_;
  mrpt::math::TPoint2D sensor_;
  double beside_;
};

}  // namespace mrpt_polyloc
