#pragma once

#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

struct ExactLocalizerParams {
  /// How far vertices of a polygon may be off [m]: rounding, not noise.
  double tolerance = 1e-6;
  std::size_t max_hypotheses = 20;  ///< at most so many are returned

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// Localization without noise: all poses from which exactly a given polygon is seen (L. Guibas, R.
/// Motwani, P. Raghavan, "The robot localization problem"), by the query without preprocessing.
///
/// The longest wall of the polygon that begins or ends at a vertex of the map is laid on every
/// border edge; each pose found so is kept if the polygon seen from it agrees. Open edges end the
/// view as walls do.
class ExactLocalizer {
 public:
  /// \throws InvalidParamsError
  explicit ExactLocalizer(const PolygonMap& map, ExactLocalizerParams params = {});

  /// All poses that the prior allows, sorted by x, y and heading; equal weights, cost 0, covariance
  /// of the tolerance. Status: unique, ambiguous, or no_match.
  /// \param view the visibility polygon around the robot, in its frame [m], counterclockwise
  /// \throws InvalidParamsError as SeenPolygon, or for a bad prior. O(n) views.
  LocalizationResult localize(const std::vector<TPoint2D>& view, const PosePrior& prior = {}) const;

  std::size_t bytes() const;  ///< memory of what was prepared

 private:
  struct Border {
    TPoint2D from, to;  ///< free space on the left
  };

  ExactLocalizerParams params_;
  Triangulation triangulation_;
  std::vector<Border> borders_;
};

}  // namespace mrpt_polyloc
