#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/SkeletonClasses.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// Localization without noise, by the query with preprocessing of L. Guibas, R. Motwani, P.
/// Raghavan, "The robot localization problem": what is seen is looked up among the skeletons of the
/// map's visibility cells; the answers are those of ExactLocalizer.
///
/// Where the polygon is in doubt (ObservedPolygon::isClear), or nothing is found, ExactLocalizer is
/// asked: then, and only then, a query costs as much as one without preprocessing.
class POLYLOC_EXPORT SkeletonLocalizer {
 public:
  /// Visibility cells at most, unless told otherwise: a few seconds and some 250 MB while they are
  /// built.
  static constexpr std::size_t kDefaultCells = 100'000;

  /// \throws CellBudgetError if the map may have more cells, before anything is built: it gives the
  /// count. InvalidMapError, InvalidParamsError
  explicit SkeletonLocalizer(const PolygonMap& map, ExactLocalizerParams params = {},
                             std::size_t max_cells = kDefaultCells);
  SkeletonLocalizer(const SkeletonLocalizer&) = delete;
  SkeletonLocalizer& operator=(const SkeletonLocalizer&) = delete;

  /// As ExactLocalizer::localize(). `positions` are the embeddings of the classes found.
  /// O(m log m + log N) for a polygon of m vertices and N cells, and for each answer a view.
  ExactAnswers localize(const std::vector<TPoint2D>& view, const PosePrior& prior = {}) const;

  /// Whether so many queries are answered sooner with preprocessing than by ExactLocalizer, by the
  /// measured cost of a cell and of a single shot (tests/bench/exact_bench.cpp), and the map has at
  /// most `max_cells` cells. Counts the cells only where the queries could pay for the count.
  static bool pays(const PolygonMap& map, std::size_t queries,
                   std::size_t max_cells = kDefaultCells);

  double tolerance() const { return params_.tolerance; }  ///< [m]
  const VisibilityCells& cells() const { return cells_; }
  const SkeletonClasses& classes() const { return classes_; }
  std::size_t bytes() const;  ///< memory of what was prepared

 private:
  ExactLocalizerParams params_;
  VisibilityCells cells_;
  SkeletonClasses classes_;
  ExactLocalizer single_shot_;
};

}  // namespace mrpt_polyloc
