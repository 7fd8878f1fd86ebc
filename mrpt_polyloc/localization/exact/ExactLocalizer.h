#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/exact/ExactAnswers.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

struct POLYLOC_EXPORT ExactLocalizerParams {
  /// How far vertices of a polygon may be off [m]: rounding, not noise.
  double tolerance = 1e-6;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Localization without noise: all poses from which exactly a given polygon is seen (L. Guibas, R.
/// Motwani, P. Raghavan, "The robot localization problem"), by the query without preprocessing.
///
/// The longest wall of the polygon that begins or ends at a vertex of the map is laid on every
/// border edge; each pose found so is kept if the polygon seen from it agrees. Open edges end the
/// view as walls do.
class POLYLOC_EXPORT ExactLocalizer {
 public:
  /// \throws InvalidParamsError
  explicit ExactLocalizer(const PolygonMap& map, ExactLocalizerParams params = {});

  /// All poses that the prior allows.
  /// \param view the visibility polygon around the robot, in its frame [m], counterclockwise
  /// \throws InvalidParamsError as ObservedPolygon, or for a bad prior. O(n) views.
  ExactAnswers localize(const std::vector<TPoint2D>& view, const PosePrior& prior = {}) const;

  double tolerance() const { return params_.tolerance; }  ///< [m]
  std::size_t bytes() const;                              ///< memory of what was prepared

 private:
  struct Border {
    TPoint2D from, to;  ///< free space on the left
  };

  ExactLocalizerParams params_;
  Triangulation triangulation_;
  std::vector<Border> borders_;
};

}  // namespace mrpt_polyloc
