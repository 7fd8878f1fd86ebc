// Polar coordinate metric: ns per pair of views and per merged interval.

#include "tests/support/certified_rotation.h"
#include "tests/support/exact_polar_metric.h"
#include "tests/support/feature_distance.h"
#include <mrpt_polyloc/polar/FourierBound.h>
#include <mrpt_polyloc/polar/PolarMetric.h>

#include <benchmark/benchmark.h>

#include <tests/support/star_polygons.h>

namespace {

using namespace mrpt_polyloc;

PolarFunction randomFunction(std::mt19937& random, std::size_t directions) {
  const auto polygon = test::randomStarPolygon(random, directions);
  return PolarFunction::fromPolygon(polygon.vertices, polygon.kernel);
}

std::vector<SampledPolarFunction> randomViews(std::size_t k) {
  std::mt19937 random(1);
  std::vector<SampledPolarFunction> views;
  for (int i = 0; i < 64; ++i) views.emplace_back(randomFunction(random, 40), k);
  return views;
}

void sampledWithCompass(benchmark::State& state) {
  const auto views = randomViews(static_cast<std::size_t>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(distance(views[i % 64], views[(7 * i + 1) % 64])), ++i;
}
BENCHMARK(sampledWithCompass)->Arg(360)->Arg(512);

void sampledOverRotations(benchmark::State& state) {
  const auto views = randomViews(static_cast<std::size_t>(state.range(0)));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(distanceOverRotations(views[i % 64], views[(7 * i + 1) % 64])), ++i;
}
BENCHMARK(sampledOverRotations)->Arg(128)->Arg(360)->Arg(512)->Arg(720);

void sampledPartialOverRotations(benchmark::State& state) {
  const auto views = randomViews(360);
  std::vector<double> bearings, ranges;
  for (int i = -90; i <= 90; ++i) {
    bearings.push_back(i * kPi / 180);
    ranges.push_back(4.0 + i % 3);
  }
  const SampledPolarFunction scan(PolarFunction::fromBeams(bearings, ranges), 360);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(distanceOverRotations(scan, views[i % 64])), ++i;
}
BENCHMARK(sampledPartialOverRotations);

/// The reference: every rotation by its sum.
void sampledOverRotationsBySums(benchmark::State& state) {
  const auto views = randomViews(360);
  std::size_t i = 0;
  for (auto _ : state) {
    const float* const f = views[i % 64].samples().data();
    const float* const g = views[(7 * i + 1) % 64].samples().data();
    float least = 1e30F;
    for (std::size_t s = 0; s < 360; ++s) {
      float sum = 0.0F;
      for (std::size_t j = 0; j < 360; ++j) {
        const float e = f[j + 360 - s < 360 ? j + 360 - s : j - s] - g[j];
        sum += e * e;
      }
      least = sum < least ? sum : least;
    }
    benchmark::DoNotOptimize(least);
    ++i;
  }
}
BENCHMARK(sampledOverRotationsBySums);

void fourierFeatureDistance(benchmark::State& state) {
  std::vector<std::vector<double>> features;
  for (const auto& view : randomViews(360)) features.push_back(fourierFeature(view, 16));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(test::featureDistance(features[i % 64], features[(7 * i + 1) % 64])),
        ++i;
}
BENCHMARK(fourierFeatureDistance);

void makePolarFunction(benchmark::State& state) {
  std::mt19937 random(1);
  const auto polygon = test::randomStarPolygon(random, 40);
  for (auto _ : state)
    benchmark::DoNotOptimize(PolarFunction::fromPolygon(polygon.vertices, polygon.kernel));
}
BENCHMARK(makePolarFunction);

void samplePolarFunction(benchmark::State& state) {
  std::mt19937 random(1);
  const PolarFunction f = randomFunction(random, 40);
  for (auto _ : state) benchmark::DoNotOptimize(SampledPolarFunction(f, 360));
}
BENCHMARK(samplePolarFunction);

void exactFourierFeature(benchmark::State& state) {
  std::mt19937 random(1);
  const PolarFunction f = randomFunction(random, 40);
  for (auto _ : state) benchmark::DoNotOptimize(fourierFeature(f, 16));
}
BENCHMARK(exactFourierFeature);

std::vector<PolarFunction> randomFunctions(std::size_t directions) {
  std::mt19937 random(1);
  std::vector<PolarFunction> functions;
  for (int i = 0; i < 64; ++i) functions.push_back(randomFunction(random, directions));
  return functions;
}

/// Walls against walls, or against the sectors of a scan; `s/interval` is per merged interval.
void exactAtOneRotation(benchmark::State& state, bool scan) {
  auto functions = randomFunctions(static_cast<std::size_t>(state.range(0)));
  const auto walls = functions;
  if (scan)
    for (auto& f : functions) {
      std::vector<double> bearings, ranges;
      for (int i = 0; i < 360; ++i) {
        bearings.push_back(i * kPi / 180);
        ranges.push_back(f.value(bearings.back()));
      }
      f = PolarFunction::fromBeams(bearings, ranges);
    }
  std::size_t i = 0;
  double intervals = 0.0;
  for (auto _ : state) {
    const PolarFunction& f = functions[i % 64];
    const PolarFunction& g = walls[(7 * i + 1) % 64];
    benchmark::DoNotOptimize(distance(f, g, 0.01 * static_cast<double>(i)));
    intervals += static_cast<double>(f.pieces().size() + g.pieces().size());
    ++i;
  }
  state.counters["s/interval"] =
      benchmark::Counter(intervals, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(exactAtOneRotation, walls, false)->Arg(50)->Arg(200);
BENCHMARK_CAPTURE(exactAtOneRotation, sectors, true)->Arg(50);

void certifiedOverRotations(benchmark::State& state) {
  const auto functions = randomFunctions(40);
  const double tolerance = 1.0 / static_cast<double>(state.range(0));
  std::size_t i = 0;
  double evaluations = 0.0;
  for (auto _ : state) {
    auto match = distanceOverRotations(functions[i % 64], functions[(7 * i + 1) % 64], {},
                                       CertificateParams{tolerance, 1000000});
    benchmark::DoNotOptimize(match);
    evaluations += static_cast<double>(match.evaluations);
    ++i;
  }
  state.counters["evaluations"] =
      benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(certifiedOverRotations)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
