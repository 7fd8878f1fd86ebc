// The visibility region of a point: us of the median over random points, against CGAL's exact
// triangular expansion in the same run (counter `ratio`), and the time to triangulate large maps.
#include "tests/support/cgal_visibility.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/Stopwatch.h>
#include <mrpt_polyloc/visibility/visibility_polygon.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kPoints = 1000;

/// CPU time of the calling thread, so that a busy machine does not count [s].
double cpuSeconds() {
  return 1e-3 * threadCpuMs();
}

/// The median over the points of the time of one call, each taken as the least of `rounds`.
template <class Work>
double medianSeconds(const std::vector<TPoint2D>& points, int rounds, Work&& work) {
  std::vector<double> seconds(points.size(), 1e9);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double start = cpuSeconds();
      work(points[i]);
      seconds[i] = std::min(seconds[i], cpuSeconds() - start);
    }
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return *middle;
}

void seeFromPoints(benchmark::State& state, const test::FloorPlanParams& params) {
  const PolygonMap map = test::floorPlan(params, 1);
  std::mt19937 random(1);
  const std::vector<TPoint2D> points = test::randomFreePoints(map, kPoints, random);
  const Triangulation triangulation(map);
  ViewExpander expander(triangulation);
  for (auto _ : state) {
    for (const TPoint2D& p : points) {
      benchmark::DoNotOptimize(visibilityPolygon(triangulation, expander.expand(p)).data());
    }
  }
  // A clock call costs a good part of a view: it is measured and taken off on both sides.
  const double clock = medianSeconds(points, 20, [](const TPoint2D&) {});
  const double view = medianSeconds(points, 20, [&](const TPoint2D& p) {
    benchmark::DoNotOptimize(expander.expand(p).ends.data());
  });
  const double polygon = medianSeconds(points, 20, [&](const TPoint2D& p) {
    benchmark::DoNotOptimize(visibilityPolygon(triangulation, expander.expand(p)).data());
  });
  const test::CgalVisibility oracle(test::borders(map));
  const double cgal =
      medianSeconds(points, 2, [&](const TPoint2D& p) { benchmark::DoNotOptimize(oracle.see(p)); });
  state.counters["n"] = static_cast<double>(map.vertexCount());
  state.counters["view_us"] = 1e6 * (view - clock);
  state.counters["polygon_us"] = 1e6 * (polygon - clock);
  state.counters["cgal_us"] = 1e6 * (cgal - clock);
  state.counters["view_ratio"] = (cgal - clock) / (view - clock);
  state.counters["ratio"] = (cgal - clock) / (polygon - clock);
}

void triangulate(benchmark::State& state) {
  test::FloorPlanParams params = test::noisyFloor();
  params.edge_length = 0.05;
  params.jitter = 0.01;
  const PolygonMap map = test::floorPlan(params, 1);
  for (auto _ : state) {
    const Triangulation triangulation(map);
    benchmark::DoNotOptimize(triangulation.faces().data());
  }
  state.counters["n"] = static_cast<double>(map.vertexCount());
}

BENCHMARK_CAPTURE(seeFromPoints, small_flat, test::smallFlat())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(seeFromPoints, large_floor, test::largeFloor())->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(seeFromPoints, furnished_floor, test::furnishedFloor())
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(triangulate)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrpt_polyloc
