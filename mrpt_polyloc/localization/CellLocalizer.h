#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/localization/SearchOptions.h>
#include <mrpt_polyloc/localization/nearest_cells/ScanViewParams.h>
#include <mrpt_polyloc/localization/ranking/HypothesisParams.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/scan/PoseRefinerParams.h>
#include <mrpt_polyloc/localization/scan/RangeScan.h>
#include <mrpt_polyloc/localization/scan/RobustCostParams.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

class ViewIndex;

/// How the nearest views are found; the answers are the same.
enum class NearestViews {
  index,  ///< lower bounds of all views in a row, see ViewIndex
  /// The paper's monotonous bisector tree, see ViewTree. It serves scans that see all around, with
  /// no heading known; others have no triangle inequality to go by, and are left to the index.
  tree
};

struct POLYLOC_EXPORT CellLocalizerParams {
  int threads = 0;  ///< for the views of the cells; 0: all cores
  /// Range of the visibility cells [m], see VisibilityCellsParams. Not given: unlimited if the
  /// cells fit the budget, else the greatest of 0.0625 m times powers of 2^(1/2) at which they do.
  std::optional<double> range;
  std::size_t max_cells = 200'000;  ///< the budget; a cell takes about 1.8 KB
  /// Of a cell wider than this, one view says too little: more are taken on a lattice of this
  /// spacing [m]. Refinement finds the optimum from half of it.
  double spacing = 0.5;
  ScanViewParams view;
  /// The nearest cells are taken until they make so many different poses (one per 0.3 m and 5
  /// degrees): neighbouring cells tell the same.
  std::size_t max_candidates = 400;
  /// ... or are farther than this share of the nearest one's distance plus the margin: a view from
  /// half the spacing away may differ much, by what shows behind corners.
  double distance_share = 3.0;
  double distance_margin = 1.0;  ///< [m rad^(1/2)]; 0.4 m all around
  std::size_t least_hits = 15;   ///< scans with fewer hits are not searched for
  NearestViews nearest = NearestViews::index;
  RobustCostParams cost;
  PoseRefinerParams refinement;
  HypothesisParams hypotheses;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The pipeline of R. Karch, H. Noltemeier, M. Schwark, T. Wahl, "Robot localization using polygon
/// distances" (1999): a representative view for every visibility cell, the cells nearest to the
/// scan under the polar coordinate metric, the pose refined in the cell.
///
/// The nearest cells are exact for the sampled metric (ViewIndex); refinement and ranking are those
/// of GlobalLocalizer. The metric is not robust: whatever stands in the way counts in full, so that
/// cluttered scans are better left to GlobalLocalizer. Of a view that fits under several rotations
/// only the best is a candidate.
///
/// Building prepares the views; localize() is const, thread-safe and deterministic.
class POLYLOC_EXPORT CellLocalizer {
 public:
  /// \throws CellBudgetError if the map has too many cells in the range given or, none given, of
  /// any range; InvalidMapError, InvalidParamsError
  explicit CellLocalizer(MapIndex::Ptr index, CellLocalizerParams params = {});
  /// With an index of its own.
  explicit CellLocalizer(PolygonMap map, CellLocalizerParams params = {});
  ~CellLocalizer();
  CellLocalizer(CellLocalizer&&) noexcept;
  CellLocalizer& operator=(CellLocalizer&&) noexcept;

  /// Poses that explain the scan. Never throws for what a scan contains: a scan that cannot be
  /// localized is a status. \throws InvalidParamsError for a prior that is not finite or in range
  /// Of the options, the metric and regions have no meaning here.
  LocalizationResult localize(const RangeScan& scan, const PosePrior& prior = {},
                              const SearchOptions& options = {}) const;

  const PolygonMap& map() const;
  double cellRange() const;        ///< of the cells, see CellLocalizerParams::range [m]
  std::size_t cellCount() const;   ///< visibility cells
  const ViewIndex& views() const;  ///< one or more per cell
  const std::vector<TPoint2D>& viewpoints() const;  ///< where they are taken [m]
  std::size_t indexBytes() const;  ///< memory of what was prepared, the map's index included

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrpt_polyloc
