#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewTree.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrpt_polyloc {
namespace {

/// Views are sampled in single precision; their correlations are off by some 1e-7 of the norms.
constexpr double kMetricError = 1e-6;

std::vector<const SampledPolarFunction*> pointersTo(
    const std::vector<SampledPolarFunction>& views) {
  std::vector<const SampledPolarFunction*> pointers;
  pointers.reserve(views.size());
  for (const SampledPolarFunction& view : views) pointers.push_back(&view);
  return pointers;
}

double errorFor(const std::vector<SampledPolarFunction>& views) {
  double norm = 0.0;
  for (const SampledPolarFunction& view : views) norm = std::max(norm, view.squaredNorm());
  return kMetricError * std::sqrt(norm);
}

}  // namespace

double ViewTree::OverRotations::operator()(const SampledPolarFunction* a,
                                           const SampledPolarFunction* b) const {
  return distanceOverRotations(*a, *b).distance;
}

ViewTree::ViewTree(const ViewIndex& views)
    : tree_(pointersTo(views.views()), {}, {}, 0, errorFor(views.views())) {}

bool ViewTree::serves(const ViewIndex::Query& query) {
  return query.scan.isComplete() && query.rotations.isFullCircle() && std::isinf(query.reach);
}

std::size_t ViewTree::visitNearest(
    const ViewIndex::Query& query,
    const std::function<bool(const ViewIndex::Neighbor&)>& visit) const {
  if (!serves(query)) {
    throw InvalidParamsError("query: a view that is not complete, or not of any heading");
  }
  return tree_.visitNearest(&query.scan, [&](std::size_t view, double distance) {
    if (query.accepts && !query.accepts(view)) return true;
    const RotationMatch match = distanceOverRotations(query.scan, *tree_.objects()[view]);
    return visit({view, distance, match.finer_rotation});
  });
}

std::size_t ViewTree::bytes() const {
  return tree_.size() * (sizeof(tree_.objects()[0]) + sizeof(double)) +
         tree_.nodes().size() * sizeof(tree_.nodes()[0]);
}

}  // namespace mrpt_polyloc
