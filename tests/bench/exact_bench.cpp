// Exact localization of one view without preprocessing, with and without a compass.
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/localization/ExactLocalizer.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <benchmark/benchmark.h>

#include <random>
#include <vector>

namespace mrpt_polyloc {
namespace {

void singleShot(benchmark::State& state, bool has_compass) {
  test::FloorPlanParams params = test::smallFlat();
  params.rooms_per_side *= 2;
  const PolygonMap map = test::floorPlan(params, 1);
  const ExactLocalizer localizer(map);
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation, true);
  std::mt19937 random(1);
  std::vector<std::vector<TPoint2D>> views;
  for (const TPoint2D& p : test::randomFreePoints(map, 64, random)) {
    views.push_back(visibilityPolygon(triangulation, expander.expand(p)));
    for (TPoint2D& vertex : views.back()) vertex = vertex - p;
  }
  PosePrior prior;
  if (has_compass) prior.compass = PosePrior::Compass{0.0, 0.0};
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(localizer.localize(views[i++ % 64], prior));
  state.counters["n"] = static_cast<double>(map.vertexCount());
}
BENCHMARK_CAPTURE(singleShot, with_compass, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(singleShot, without_compass, false)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mrpt_polyloc
