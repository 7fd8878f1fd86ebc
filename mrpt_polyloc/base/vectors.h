#pragma once

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <cmath>

namespace mrpt_polyloc {

/// Twice the area of the triangle 0, a, b: positive if b lies to the left of a.
inline double cross(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) {
  return a.x * b.y - a.y * b.x;
}
/// The same of the triangle o, a, b.
inline double cross(const mrpt::math::TPoint2D& o, const mrpt::math::TPoint2D& a,
                    const mrpt::math::TPoint2D& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}
inline double dot(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) {
  return a.x * b.x + a.y * b.y;
}

/// By an angle [rad] to the left.
inline mrpt::math::TPoint2D turned(const mrpt::math::TPoint2D& p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// Between a point and the nearest one of a segment, which may be a single point.
inline double distanceToSegment(const mrpt::math::TPoint2D& p, const mrpt::math::TPoint2D& a,
                                const mrpt::math::TPoint2D& b) {
  const mrpt::math::TPoint2D along = b - a, from = p - a;
  const double squared = dot(along, along);
  const double share = squared > 0.0 ? std::clamp(dot(from, along) / squared, 0.0, 1.0) : 0.0;
  return (from - along * share).norm();
}

}  // namespace mrpt_polyloc
