#pragma once

#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/exact/ExactAnswers.h>
#include <mrpt_polyloc/localization/exact/ObservedPolygon.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A wall of a seen polygon, of which an end is a vertex of the map.
struct WallAnchor {
  TPoint2D from, to;      ///< [m]
  bool at_begin = false;  ///< whether `from` is a vertex of the map, else `to` is
  double length = 0.0;    ///< [m]
};

/// The longest one. \throws InvalidParamsError if there is none
WallAnchor longestAnchor(const ObservedPolygon& seen);

/// The last step of every exact query: poses that may be answers come in, and those stay from which
/// the polygon is seen, once each. For one query.
class ExactCandidates {
 public:
  ExactCandidates(const Triangulation& triangulation, const ObservedPolygon& seen,
                  const PosePrior& prior, double tolerance);

  const WallAnchor& anchor() const { return anchor_; }
  /// How far poses laid by the anchor or better may carry points of the polygon off [m].
  double limit() const { return limit_; }

  /// Keeps a pose if the prior allows it and the view computed there agrees with the polygon. A
  /// view and O(m log m) for a polygon of m vertices.
  void consider(const mrpt::math::TPose2D& pose);
  std::size_t kept() const { return poses_.size(); }

  ExactAnswers answers() const;

 private:
  bool isAllowed(const mrpt::math::TPose2D& pose) const;
  bool isKnown(const mrpt::math::TPose2D& pose) const;

  const Triangulation* triangulation_;
  const ObservedPolygon* seen_;
  const PosePrior* prior_;
  double tolerance_;
  WallAnchor anchor_;
  double slack_, limit_;
  ViewExpander expander_;
  std::vector<mrpt::math::TPose2D> poses_;
  std::size_t evaluated_ = 0;
};

}  // namespace mrpt_polyloc
