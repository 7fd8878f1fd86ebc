#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/nearest_cells/MetricTree.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>

#include <cstddef>
#include <functional>

namespace mrpt_polyloc {

/// The nearest views by the paper's monotonous bisector tree (R. Karch et al., 1999), under the
/// sampled polar coordinate metric over all rotations: the order is ViewIndex's. It evaluates the
/// metric far more often than ViewIndex does (doc/performance.md): it is the reference.
///
/// Immutable, queries const and thread-safe. Refers to the index, which must outlive it.
class POLYLOC_EXPORT ViewTree {
 public:
  /// O(n log n) evaluations of the metric, as a rule, for n views.
  explicit ViewTree(const ViewIndex& views);

  /// Whether the triangle inequality holds between a query and the views: it sees all around, its
  /// heading is unknown, and it sees as far as they do.
  static bool serves(const ViewIndex::Query& query);

  /// As ViewIndex::visitNearest(). \throws InvalidParamsError also if it does not serve the query
  std::size_t visitNearest(const ViewIndex::Query& query,
                           const std::function<bool(const ViewIndex::Neighbor&)>& visit) const;

  std::size_t bytes() const;  ///< memory, without the views

 private:
  struct OverRotations {
    double operator()(const SampledPolarFunction* a, const SampledPolarFunction* b) const;
  };

  MetricTree<const SampledPolarFunction*, OverRotations> tree_;
};

}  // namespace mrpt_polyloc
