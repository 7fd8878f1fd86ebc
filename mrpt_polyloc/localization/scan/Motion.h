#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/math/TPose2D.h>

namespace mrpt_polyloc {

/// How far wheels are wrong: standard deviations of a movement's pose, in shares of its length and
/// of its turn. Errors of movements one after the other are independent.
struct POLYLOC_EXPORT MotionNoise {
  double position_per_metre = 0.02;               ///< along and across, each [m/m]
  double heading_per_metre = 0.017453292519943;   ///< [rad/m], a degree
  double heading_per_radian = 0.034906585039887;  ///< [rad/rad], two degrees

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// How a robot moved between two moments, and how sure that is.
struct POLYLOC_EXPORT Motion {
  mrpt::math::TPose2D pose_before_after{0, 0, 0};  ///< the later pose seen from the earlier one
  /// Of (x, y, phi) of that pose, in the earlier one's axes [m, rad].
  mrpt::math::CMatrixDouble33 covariance = mrpt::math::CMatrixDouble33::Zero();

  double length() const;  ///< of the straight line [m]
  /// \throws InvalidParamsError unless all is finite and no variance negative.
  void check() const;
};

/// A movement as wheels measured it, with the covariance that their noise gives it.
POLYLOC_EXPORT Motion measuredMotion(const mrpt::math::TPose2D& pose_before_after,
                                     const MotionNoise& noise = {});

/// First one movement, then the other; covariances to first order.
POLYLOC_EXPORT Motion operator+(const Motion& first, const Motion& second);

/// The way back: the earlier pose seen from the later one; covariance to first order.
POLYLOC_EXPORT Motion inverse(const Motion& motion);

/// A pose that is known up to a covariance, moved: the same to first order. \param covariance of
/// (x, y, phi) in the map, replaced by that of the pose after the movement
POLYLOC_EXPORT mrpt::math::TPose2D move(const mrpt::math::TPose2D& pose_map_robot,
                                        const Motion& motion,
                                        mrpt::math::CMatrixDouble33& covariance);

}  // namespace mrpt_polyloc
