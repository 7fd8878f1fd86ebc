#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/LimitedView.h>
#include <mrpt_polyloc/localization/exact/clear_stretches.h>

#include <mrpt/math/TPose2D.h>

#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// All poses from which a view of limited range is seen. Where it holds a corner, these are points;
/// where it holds but one wall or two parallel ones, the robot may move along them; where it holds
/// nothing, it may stand anywhere far enough from every border.
struct LimitedAnswers {
  struct Segment {
    TPoint2D from, to;  ///< of the robot in the map, both ends with it [m]
    double heading;     ///< at every point of it [rad]
  };
  /// All points of free space that are no nearer to its border than the range, at any heading.
  struct Region {
    double clearance;  ///< the range [m]
    TPoint2D inside;   ///< one point of it, as far from the border as found
  };
  std::vector<mrpt::math::TPose2D> points;  ///< sorted by x, y and heading
  std::vector<Segment> segments;            ///< sorted by x and y of `from`, and heading
  std::optional<Region> region;

  bool empty() const { return points.empty() && segments.empty() && !region; }
};

/// Exact localization where sight ends at a known range: ExactLocalizer for LimitedView. Open edges
/// end the view as walls do.
class LimitedRangeLocalizer {
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
