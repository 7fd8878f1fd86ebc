// Exact localization of one view, with preprocessing and without, with and without a compass, on
// floors of n = 100, 196 and 388 vertices: two rows of rooms along a corridor, as many times as
// many as the argument says.
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/localization/exact/ExactLocalizer.h>
#include <mrpt_polyloc/localization/exact/SkeletonLocalizer.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <vector>

namespace mrpt_polyloc {
namespace {

using Views = std::vector<std::vector<TPoint2D>>;

PolygonMap floorOf(const benchmark::State& state) {
  test::FloorPlanParams params = test::smallFlat();
  params.rooms_per_side *= static_cast<int>(state.range(0));
  return test::floorPlan(params, 1);
}

Views randomViews(const PolygonMap& map) {
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation, true);
  std::mt19937 random(1);
  Views views;
  for (const TPoint2D& p : test::randomFreePoints(map, 256, random)) {
    views.push_back(visibilityPolygon(triangulation, expander.expand(p)));
    for (TPoint2D& vertex : views.back()) vertex = vertex - p;
  }
  return views;
}

/// CPU time of this thread [us].
double cpuMicroseconds() {
  return 1e3 * threadCpuMs();
}

/// Runs all views; adds the median and the 90th percentile over the queries.
template <class Localizer>
void query(benchmark::State& state, const Localizer& localizer, const Views& views,
           bool has_compass) {
  PosePrior prior;
  if (has_compass) prior.compass = PosePrior::Compass{0.0, 0.0};
  std::vector<double> took;
  std::size_t i = 0, answers = 0, by_classes = 0;
  for (auto _ : state) {
    const double start = cpuMicroseconds();
    const ExactAnswers result = localizer.localize(views[i++ % views.size()], prior);
    took.push_back(cpuMicroseconds() - start);
    answers += result.poses.size();
    by_classes += result.positions > 0 ? 1 : 0;
  }
  std::sort(took.begin(), took.end());
  const auto count = static_cast<double>(took.size());
  state.counters["median_us"] = took[took.size() / 2];
  state.counters["p90_us"] = took[took.size() * 9 / 10];
  state.counters["answers"] = static_cast<double>(answers) / count;
  state.counters["by_classes"] = static_cast<double>(by_classes) / count;
}

void singleShot(benchmark::State& state, bool has_compass) {
  const PolygonMap map = floorOf(state);
  query(state, ExactLocalizer(map), randomViews(map), has_compass);
  state.counters["n"] = static_cast<double>(map.vertexCount());
}
BENCHMARK_CAPTURE(singleShot, with_compass, true)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(singleShot, without_compass, false)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Unit(benchmark::kMicrosecond);

void preprocessed(benchmark::State& state, bool has_compass) {
  const PolygonMap map = floorOf(state);
  const SkeletonLocalizer localizer(map, {}, 1'000'000);
  query(state, localizer, randomViews(map), has_compass);
  state.counters["n"] = static_cast<double>(map.vertexCount());
  state.counters["cells"] = static_cast<double>(localizer.cells().size());
  state.counters["classes"] = static_cast<double>(localizer.classes().size());
  state.counters["mb"] = static_cast<double>(localizer.bytes()) * 1e-6;
}
BENCHMARK_CAPTURE(preprocessed, with_compass, true)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(preprocessed, without_compass, false)
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Unit(benchmark::kMicrosecond);

/// Cells and classes apart.
void prepareCells(benchmark::State& state) {
  const PolygonMap map = floorOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(VisibilityCells(map).size());
}
BENCHMARK(prepareCells)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

void prepareClasses(benchmark::State& state) {
  const VisibilityCells cells(floorOf(state));
  for (auto _ : state) benchmark::DoNotOptimize(SkeletonClasses(cells, 1e-6).size());
  state.counters["cells"] = static_cast<double>(cells.size());
}
BENCHMARK(prepareClasses)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrpt_polyloc
