#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/LimitedAnswers.h>
#include <mrpt_polyloc/localization/exact/LimitedView.h>
#include <mrpt_polyloc/localization/exact/clear_stretches.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// Exact localization where sight ends at a known range: ExactLocalizer for LimitedView. Open edges
/// end the view as walls do.
class POLYLOC_EXPORT LimitedRangeLocalizer {
 public:
  /// \throws InvalidParamsError
  explicit LimitedRangeLocalizer(const PolygonMap& map, ExactLocalizerParams params = {});

  /// All poses that agree with the view, and with the compass if there is one. The tolerance is
  /// that of ExactLocalizer; a segment may go on for some (2 range tolerance)^(1/2) [m] where a
  /// corner just begins to show.
  ///
  /// With a vertex of the map in the view O(n) views; with walls that are not parallel and no
  /// vertex O(n^2) pairs of edges; with one wall or two parallel ones O(n^2 log n); with nothing a
  /// search for the point farthest from the border, by squares down to a millimetre that could
  /// hold it: a region that a robot fits in with less play may be missed.
  /// \throws InvalidParamsError as LimitedPolygon, or for a bad compass
  LimitedAnswers localize(const LimitedView& view,
                          const std::optional<PosePrior::Compass>& compass = {}) const;

  double tolerance() const { return tolerance_; }  ///< [m]
  std::size_t bytes() const;                       ///< memory of what was prepared

  /// Distance of a point of free space from its border [m]; negative outside. O(n).
  double clearance(const TPoint2D& point) const;

 private:
  struct Query;
  void layAnchor(const LimitedPolygon& view, Query& query) const;
  void layPairs(const LimitedPolygon& view, Query& query) const;
  void laySegments(const LimitedPolygon& view, Query& query) const;
  std::optional<LimitedAnswers::Region> clearRegion(double range) const;
  void consider(const LimitedPolygon& view, const mrpt::math::TPose2D& pose, double limit,
                Query& query) const;

  double tolerance_;
  Triangulation triangulation_;
  BoundingBox box_;
  std::vector<BorderEdge> edges_;
};

}  // namespace mrpt_polyloc
