#pragma once

#include <mrpt/math/TPoint2D.h>

#include <cmath>

namespace mrpt_polyloc {

/// The sign of the turn a -> b -> c by exact arithmetic (CGAL); use orientation().
int exactOrientation(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b,
                     const mrpt::math::TPoint2D& c);

/// The sign of the turn a -> b -> c: 1 left (counterclockwise), -1 right, 0 collinear. Exact: a
/// double filter with Shewchuk's error bound, exact arithmetic where that cannot decide.
inline int orientation(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b,
                       const mrpt::math::TPoint2D& c) {
  // (3 + 16 eps) eps, eps = 2^-53: J. R. Shewchuk, "Adaptive precision floating-point arithmetic
  // and fast robust geometric predicates", 1997, section 4.3.
  constexpr double kErrorBound = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  const double bound = kErrorBound * (std::abs(left) + std::abs(right));
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return exactOrientation(a, b, c);
}

}  // namespace mrpt_polyloc
