#pragma once

#include <mrpt_polyloc/base/Lazy.h>
#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/PolygonMap.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/MapIndex.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <cstddef>

namespace mrpt_polyloc {

/// What a MapIndex holds. Not installed: later versions will hold it otherwise.
class POLYLOC_EXPORT MapIndexParts {
 public:
  MapIndexParts(PolygonMap polygon_map, const MapIndexParams& params);

  PolygonMap map;
  MapIndexParams params;
  double build_seconds = 0.0;

  const Triangulation& triangulation() const;
  const RangePredictor& predictor(BuildProgress* progress = nullptr) const;
  const SearchTree& tree(BuildProgress* progress = nullptr) const;
  /// Takes parts that were stored. \throws InvalidMapError if they do not fit
  void take(VisibleEdgeIndex::Lists edges, SearchTree::Data tree);
  std::size_t bytes() const;

  /// The squares of the index of edges are so many leaves wide: the measured optimum of both.
  static constexpr double kLeavesPerSquare = 4.0;

 private:
  Lazy<Triangulation> triangulation_;
  Lazy<RangePredictor> predictor_;
  Lazy<SearchTree> tree_;
};

}  // namespace mrpt_polyloc
