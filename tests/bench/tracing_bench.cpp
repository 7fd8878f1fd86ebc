/// Tracing of a synthetic noisy grid: sides of 1,000 cells up to 5,000 x 4,600. Counters: vertices
/// and holes of the map, and the border corners before simplification.
#include "tests/support/noisy_grid.h"
#include <mrpt_polyloc/geometry/tracing.h>

#include <benchmark/benchmark.h>

namespace mrpt_polyloc::test {
namespace {

void traceNoisyGrid(benchmark::State& state, double tolerance_cells) {
  const OccupancyBitmap bitmap =
      noisyGrid(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 1);
  TracingParams params;
  params.tolerance_cells = tolerance_cells;
  std::size_t vertices = 0;
  std::size_t holes = 0;
  for (auto _ : state) {
    const PolygonMap map = traceBitmap(bitmap, params);
    vertices = map.vertexCount();
    holes = map.holeCount();
  }
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["holes"] = static_cast<double>(holes);
}

void trace(benchmark::State& state) {
  traceNoisyGrid(state, TracingParams{}.tolerance_cells);
}
void traceExactly(benchmark::State& state) {
  traceNoisyGrid(state, 0.0);
}

BENCHMARK(trace)
    ->Args({1000, 1000})
    ->Args({2000, 2000})
    ->Args({5000, 4600})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(traceExactly)->Args({5000, 4600})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrpt_polyloc::test
