// Visibility cells: windows, cells, build time and memory as the map grows; and the nearest of
// 100,000 views by bounds in a row, by the metric tree, and by trying all.
#include "tests/support/map_factories.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/nearest_cells/MetricTree.h>
#include <mrpt_polyloc/localization/nearest_cells/ViewIndex.h>
#include <mrpt_polyloc/localization/nearest_cells/cell_views.h>
#include <mrpt_polyloc/polar/PolarMetric.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <malloc.h>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

PolygonMap home(int rooms_per_side) {
  test::FloorPlanParams params = test::smallFlat();
  params.rooms_per_side = rooms_per_side;
  return test::floorPlan(params, 1);
}

PolygonMap office(int corridors) {
  test::FloorPlanParams params = test::furnishedFloor();
  params.corridors = corridors;
  return test::floorPlan(params, 1);
}

/// Square pillars 3 m apart, none in line with others: the worst case.
PolygonMap hall(int columns) {
  std::vector<std::vector<TPoint2D>> pillars;
  for (int i = 1; i <= columns; ++i) {
    for (int j = 1; j <= columns; ++j) {
      const double x = 3.0 * i + 0.13 * j, y = 3.0 * j + 0.17 * i;
      pillars.push_back(test::rectangle(x, y, x + 0.5, y + 0.5));
    }
  }
  const double side = 3.3 * columns + 3.0;
  return test::mapOf(test::rectangle(0, 0, side, side), pillars);
}

/// Kilobytes of this process, now (VmRSS) or at most since resetPeak() (VmHWM). Linux.
double kilobytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != key + ":") continue;
    double value = 0.0;
    status >> value;
    return value;
  }
  return 0.0;
}
/// What was freed before must not hide what is taken now.
void resetPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

void windows(benchmark::State& state, const PolygonMap& map) {
  const Triangulation triangulation(map);
  std::size_t count = 0;
  for (auto _ : state) count = criticalSegments(triangulation).segments.size();
  state.counters["n"] = static_cast<double>(map.vertexCount());
  state.counters["windows"] = static_cast<double>(count);
}

void cells(benchmark::State& state, const PolygonMap& map, double range) {
  std::size_t count = 0, kept = 0, segments = 0;
  double peak = 0.0, processor = 0.0;
  for (auto _ : state) {
    resetPeak();
    const double before = kilobytes("VmRSS");
    const std::clock_t start = std::clock();
    const VisibilityCells built(map, {2'000'000, range});
    processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    peak = kilobytes("VmHWM") - before;
    count = built.size();
    kept = built.memory();
    segments = built.criticalSegments().segments.size();
  }
  const auto n = static_cast<double>(count);
  state.counters["n"] = static_cast<double>(map.vertexCount());
  state.counters["windows"] = static_cast<double>(segments);
  state.counters["cells"] = n;
  state.counters["us_a_cell"] = 1e6 * processor / n;
  state.counters["peak_KB_a_cell"] = peak / n;
  state.counters["kept_KB_a_cell"] = 1e-3 * static_cast<double>(kept) / n;
}

/// Views of the cells of an office, 100,000 of them, and clean scans from anywhere.
struct Views {
  Views() {
    const PolygonMap map = office(4);
    const RangePredictor predictor{Triangulation(map)};
    const VisibilityCells decomposition(map);
    std::vector<TPoint2D> viewpoints = cellViewpoints(decomposition, 0.5);
    std::mt19937 random(1);
    std::shuffle(viewpoints.begin(), viewpoints.end(), random);
    viewpoints.resize(std::min<std::size_t>(viewpoints.size(), 100'000));
    const auto index_views = viewsFrom(viewpoints, predictor, 180, 20.0, 0);
    for (const auto& view :
         viewsFrom(test::randomFreePoints(map, 200, random), predictor, 180, 20.0, 0)) {
      std::vector<float> samples = view.samples();
      std::rotate(samples.begin(), samples.begin() + static_cast<long>(random() % 180),
                  samples.end());
      scans.emplace_back(samples);
      std::fill(samples.begin(), samples.begin() + 90, std::numeric_limits<float>::quiet_NaN());
      half_scans.emplace_back(std::move(samples));
    }
    index = std::make_unique<ViewIndex>(index_views);
  }
  static const Views& get() {
    static const Views views;
    return views;
  }
  std::vector<SampledPolarFunction> scans, half_scans;
  std::unique_ptr<ViewIndex> index;
};

using Search = std::function<std::size_t(const SampledPolarFunction&)>;

/// Processor time and evaluations of the metric for one scan, their medians.
void nearest(benchmark::State& state, const std::vector<SampledPolarFunction>& scans,
             const Search& search) {
  std::vector<double> times, evaluations;
  std::size_t i = 0;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    evaluations.push_back(static_cast<double>(search(scans[i++ % scans.size()])));
    times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  state.counters["views"] = static_cast<double>(Views::get().index->size());
  state.counters["median_ms"] = median(times);
  state.counters["median_evaluations"] = median(evaluations);
}

Search byBounds(RotationRange range, std::size_t count) {
  return [range, count](const SampledPolarFunction& scan) {
    std::size_t found = 0;
    return Views::get().index->visitNearest({scan, range, kInfinity, {}},
                                            [&](const auto&) { return ++found < count; });
  };
}

struct OverRotations {
  RotationRange range;
  double operator()(const SampledPolarFunction* a, const SampledPolarFunction* b) const {
    return distanceOverRotations(*a, *b, range).distance;
  }
};
using Tree = MetricTree<const SampledPolarFunction*, OverRotations>;

Search byTree(std::size_t count) {
  return [count](const SampledPolarFunction& scan) {
    static const Tree tree = [] {
      std::vector<const SampledPolarFunction*> objects;
      for (const auto& view : Views::get().index->views()) objects.push_back(&view);
      return Tree(std::move(objects), {}, {}, 1, 1e-6);
    }();
    return tree.nearest(&scan, count).evaluations;
  };
}

std::size_t byTryingAll(const SampledPolarFunction& scan) {
  double least = kInfinity;
  for (const auto& view : Views::get().index->views()) {
    least = std::min(least, distanceOverRotations(scan, view).distance);
  }
  benchmark::DoNotOptimize(least);
  return Views::get().index->size();
}

template <class Body>
void add(const std::string& name, int iterations, Body body) {
  benchmark::RegisterBenchmark(name.c_str(), body)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(iterations);
}

const int registered = [] {
  add("windows/office", 5, [](benchmark::State& state) { windows(state, office(3)); });
  for (const int rooms : {1, 2, 4, 8, 16, 32}) {
    add("cells/home/" + std::to_string(rooms), 1,
        [rooms](benchmark::State& state) { cells(state, home(rooms), kInfinity); });
  }
  for (const int corridors : {1, 2, 4, 8}) {
    add("cells/office/" + std::to_string(corridors), 1,
        [corridors](benchmark::State& state) { cells(state, office(corridors), kInfinity); });
  }
  for (const int columns : {1, 2, 3, 4, 5, 6}) {
    add("cells/hall/" + std::to_string(columns), 1,
        [columns](benchmark::State& state) { cells(state, hall(columns), kInfinity); });
  }
  add("cells/hall/8/range8", 1, [](benchmark::State& state) { cells(state, hall(8), 8.0); });
  const auto addNearest = [](const std::string& name, int iterations, bool is_half,
                             const Search& search) {
    add("nearest/" + name, iterations, [is_half, search](benchmark::State& state) {
      const Views& views = Views::get();
      search(views.scans.front());  // what is built but once
      nearest(state, is_half ? views.half_scans : views.scans, search);
    });
  };
  addNearest("bounds/1", 200, false, byBounds({}, 1));
  addNearest("bounds/100", 200, false, byBounds({}, 100));
  addNearest("compass5deg/bounds/1", 200, false, byBounds({0.3, 0.0873}, 1));
  addNearest("half/bounds/1", 50, true, byBounds({}, 1));
  addNearest("tree/1", 50, false, byTree(1));
  addNearest("tree/100", 20, false, byTree(100));
  addNearest("all", 10, false, byTryingAll);
  addNearest("half/all", 10, true, byTryingAll);
  return 0;
}();

}  // namespace
}  // namespace mrpt_polyloc
