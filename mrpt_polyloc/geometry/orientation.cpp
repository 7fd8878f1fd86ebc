#include <mrpt_polyloc/geometry/orientation.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace mrpt_polyloc {

int exactOrientation(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b,
                     const mrpt::math::TPoint2D& c) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}

}  // namespace mrpt_polyloc
