#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/geometry/orientation.h>
#include <mrpt_polyloc/localization/nearest_cells/cell_views.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mrpt_polyloc {
namespace {

/// Cells smaller than this are left out [m2], 0.1 mm on a side: rounding may have carried their
/// corners onto a wall, and their neighbours show the same.
constexpr double kLeastArea = 1e-8;

bool isInside(const std::vector<TPoint2D>& convex, const TPoint2D& p) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    if (orientation(convex[i], convex[(i + 1) % convex.size()], p) <= 0) return false;
  }
  return true;
}

/// Appends the lattice points inside a cell that are not next to its representative.
void addLatticePoints(const std::vector<TPoint2D>& cell, const TPoint2D& representative,
                      double spacing, std::vector<TPoint2D>& viewpoints) {
  const BoundingBox box = BoundingBox::of(cell);
  if (std::hypot(box.width(), box.height()) <= spacing) return;
  for (double row = std::ceil(box.min.y / spacing); row * spacing <= box.max.y; ++row) {
    for (double column = std::ceil(box.min.x / spacing); column * spacing <= box.max.x; ++column) {
      const TPoint2D p{column * spacing, row * spacing};
      const double away = std::hypot(p.x - representative.x, p.y - representative.y);
      if (away >= 0.5 * spacing && isInside(cell, p)) viewpoints.push_back(p);
    }
  }
}

SampledPolarFunction viewOf(const PredictedRanges& ranges, double range) {
  std::vector<float> samples(ranges.wall.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float seen = std::isinf(ranges.wall[i]) ? ranges.open[i] : ranges.wall[i];
    samples[i] = std::min(seen, static_cast<float>(range));
  }
  return SampledPolarFunction(std::move(samples));
}

}  // namespace

std::vector<TPoint2D> cellViewpoints(const VisibilityCells& cells, double spacing) {
  std::vector<TPoint2D> viewpoints;
  viewpoints.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells.area(c) < kLeastArea) continue;
    const TPoint2D representative = cells.representative(c);
    viewpoints.push_back(representative);
    addLatticePoints(cells.polygon(c), representative, spacing, viewpoints);
  }
  return viewpoints;
}

std::vector<SampledPolarFunction> viewsFrom(const std::vector<TPoint2D>& viewpoints,
                                            const RangePredictor& predictor, std::size_t k,
                                            double range, int threads) {
  std::vector<double> bearings(k);
  for (std::size_t i = 0; i < k; ++i) {
    bearings[i] = kTwoPi * static_cast<double>(i) / static_cast<double>(k);
  }
  const BeamPattern pattern(bearings);
  // Placeholders, for a view has no empty state.
  std::vector<SampledPolarFunction> views(viewpoints.size(),
                                          SampledPolarFunction(std::vector<float>{0.0F, 0.0F}));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, viewpoints.size(), [&](std::size_t i) {
      thread_local PredictedRanges ranges;
      predictor.predict({viewpoints[i].x, viewpoints[i].y, 0.0}, pattern, ranges);
      views[i] = viewOf(ranges, range);
    });
  });
  return views;
}

}  // namespace mrpt_polyloc
