#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPoint2D.h>

#include <algorithm>
#include <limits>

namespace mrpt_polyloc {

using mrpt::math::TPoint2D;

/// An axis-parallel box, its sides with it [m].
struct POLYLOC_EXPORT BoundingBox {
  TPoint2D min{0, 0};
  TPoint2D max{0, 0};

  /// That of no point: it holds none, and takes the first as it is.
  static BoundingBox empty() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  }
  /// The smallest one around some points (a container of them).
  template <class Points>
  static BoundingBox of(const Points& points) {
    BoundingBox box = empty();
    for (const TPoint2D& point : points) box.include(point);
    return box;
  }

  void include(const TPoint2D& point) {
    min = {std::min(min.x, point.x), std::min(min.y, point.y)};
    max = {std::max(max.x, point.x), std::max(max.y, point.y)};
  }
  void include(const BoundingBox& box) {
    min = {std::min(min.x, box.min.x), std::min(min.y, box.min.y)};
    max = {std::max(max.x, box.max.x), std::max(max.y, box.max.y)};
  }

  double width() const { return max.x - min.x; }
  double height() const { return max.y - min.y; }
  bool isEmpty() const { return !(min.x <= max.x && min.y <= max.y); }
  /// False for what is not a number, too.
  bool contains(const TPoint2D& point) const {
    return point.x >= min.x && point.x <= max.x && point.y >= min.y && point.y <= max.y;
  }
};

}  // namespace mrpt_polyloc
