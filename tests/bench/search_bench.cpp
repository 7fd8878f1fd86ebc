// The search on generated floor plans with furniture, as a function of their area: seconds and MB
// of the index, median and 90th percentile of ms per scan of 360 beams, clean, cluttered, with a
// compass; and cluttered on all cores.
#include "tests/support/BruteForceRays.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/localization/GlobalLocalizer.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

/// Floors of about so many square metres.
PolygonMap planOfArea(double area) {
  test::FloorPlanParams params;
  params.furniture_per_room = 2;
  // A pair of rooms with its piece of the corridor has 45 m2: rows of rooms in equal shares.
  params.corridors = std::max(1, static_cast<int>(std::lround(std::sqrt(area / 45.0) / 2.0)));
  params.rooms_per_side =
      std::max(1, static_cast<int>(std::lround(area / (45.0 * params.corridors))));
  return test::floorPlan(params, 1);
}

/// What the scans are like.
struct Condition {
  const char* name;
  double short_share = 0.0;  ///< of the beams, which end early
  int occluders = 0;         ///< contiguous, 8 to 19 degrees each
  bool has_compass = false;  ///< of 10 degrees
  int threads = 1;           ///< of a search; 0: all cores
};

RangeScan scanAt(const test::BruteForceRays& rays, const TPose2D& pose, const Condition& condition,
                 std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  constexpr int kBeams = 360;
  std::vector<double> nearer(kBeams, 1.0);  // share of the range that is seen
  for (int i = 0; i < condition.occluders; ++i) {
    const int first = static_cast<int>(kBeams * unit(random));
    const int width = 8 + static_cast<int>(12 * unit(random));
    const double share = unit(random);
    for (int k = first; k < first + width; ++k) {
      nearer[static_cast<std::size_t>(k % kBeams)] = share;
    }
  }
  std::vector<Beam> beams;
  for (int i = 0; i < kBeams; ++i) {
    const double bearing = (i - 180) * kPi / 180;
    double range = rays.cast({pose.x, pose.y}, pose.phi + bearing).wall + noise(random);
    if (unit(random) < condition.short_share) range *= unit(random);
    range *= nearer[static_cast<std::size_t>(i)];
    beams.push_back({bearing, std::max(range, 0.02), BeamKind::hit});
  }
  return RangeScan(std::move(beams));
}

bool isRight(const LocalizationResult& result, const TPose2D& truth) {
  if (result.hypotheses.empty()) return false;
  const TPose2D& first = result.hypotheses.front().pose_map_robot;
  return std::hypot(first.x - truth.x, first.y - truth.y) < 0.1 &&
         std::abs(std::remainder(first.phi - truth.phi, 2 * kPi)) < 0.05;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void searchOnPlan(benchmark::State& state, double area, const Condition& condition) {
  const PolygonMap map = planOfArea(area);
  const GlobalLocalizer localizer(map);
  SearchOptions options;
  options.threads = condition.threads;
  const test::BruteForceRays rays(map);
  std::mt19937 random(1);
  std::size_t right = 0;
  double evaluated = 0.0;
  std::vector<double> ms;
  const std::vector<TPoint2D> places =
      test::randomFreePoints(map, static_cast<std::size_t>(state.max_iterations), random);
  for (auto _ : state) {
    state.PauseTiming();
    const TPoint2D& p = places[ms.size() % places.size()];
    const TPose2D pose{p.x, p.y, std::uniform_real_distribution<double>(-kPi, kPi)(random)};
    const RangeScan scan = scanAt(rays, pose, condition, random);
    PosePrior prior;
    if (condition.has_compass) {
      prior.compass = PosePrior::Compass{pose.phi + 0.1, 10.0 * kPi / 180};
    }
    state.ResumeTiming();
    const LocalizationResult result = localizer.localize(scan, prior, options);
    right += isRight(result, pose);
    ms.push_back(result.statistics.search_ms + result.statistics.refinement_ms);
    evaluated += static_cast<double>(result.statistics.evaluated);
  }
  const auto n = static_cast<double>(ms.size());
  state.counters["area"] = map.area();
  state.counters["index_s"] = localizer.index().buildSeconds();
  state.counters["index_mb"] = static_cast<double>(localizer.index().bytes()) / 1e6;
  state.counters["ms_median"] = quantile(ms, 0.5);
  state.counters["ms_p90"] = quantile(ms, 0.9);
  state.counters["evaluated"] = evaluated / n;
  state.counters["right"] = static_cast<double>(right) / n;
}

void add(int area, const Condition& condition) {
  const std::string name = "search/" + std::to_string(area) + "m2/" + condition.name;
  benchmark::RegisterBenchmark(
      name.c_str(),
      [area, condition](benchmark::State& state) { searchOnPlan(state, area, condition); })
      ->Unit(benchmark::kMillisecond)
      ->Iterations(40);
}

const int registered = [] {
  const std::vector<Condition> conditions = {{"clean"},
                                             {"10%short", 0.1},
                                             {"30%short", 0.3},
                                             {"10occluders", 0.0, 10},
                                             {"10%short+compass", 0.1, 0, true},
                                             {"10%short+cores", 0.1, 0, false, 0}};
  for (const int area : {100, 400, 1600, 6400, 10000}) {
    for (const Condition& condition : conditions) add(area, condition);
  }
  return 0;
}();

}  // namespace
}  // namespace mrpt_polyloc
