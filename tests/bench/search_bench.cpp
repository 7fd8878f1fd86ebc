// The search on generated floor plans, as a function of their area: seconds and MB of the index, ms
// per scan of 360 beams, clean and with 30 % of the beams ending early.
#include "tests/support/BruteForceRays.h"
#include "tests/support/random_maps.h"
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

constexpr double kPi = 3.14159265358979323846;

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

RangeScan scanAt(const test::BruteForceRays& rays, const TPose2D& pose, double short_share,
                 std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<Beam> beams;
  for (int i = 0; i < 360; ++i) {
    const double bearing = (i - 180) * kPi / 180;
    double range = rays.cast({pose.x, pose.y}, pose.phi + bearing).wall + noise(random);
    if (unit(random) < short_share) range *= unit(random);
    beams.push_back({bearing, range, BeamKind::hit});
  }
  return RangeScan(std::move(beams));
}

bool isRight(const LocalizationResult& result, const TPose2D& truth) {
  if (result.hypotheses.empty()) return false;
  const TPose2D& first = result.hypotheses.front().pose_map_robot;
  return std::hypot(first.x - truth.x, first.y - truth.y) < 0.1 &&
         std::abs(std::remainder(first.phi - truth.phi, 2 * kPi)) < 0.05;
}

void searchOnPlan(benchmark::State& state, double area, double short_share) {
  const PolygonMap map = planOfArea(area);
  const GlobalLocalizer localizer(map);
  const test::BruteForceRays rays(map);
  std::mt19937 random(1);
  std::vector<TPose2D> poses;
  std::vector<RangeScan> scans;
  for (const TPoint2D& p : test::randomFreePoints(map, 20, random)) {
    poses.emplace_back(p.x, p.y, std::uniform_real_distribution<double>(-kPi, kPi)(random));
    scans.push_back(scanAt(rays, poses.back(), short_share, random));
  }
  std::size_t next = 0, right = 0, count = 0, positions = 0;
  double search = 0.0, refinement = 0.0, evaluated = 0.0;
  for (auto _ : state) {
    const LocalizationResult result = localizer.localize(scans[next]);
    right += isRight(result, poses[next]);
    next = (next + 1) % scans.size();
    ++count;
    positions = result.statistics.positions;
    search += result.statistics.search_ms;
    refinement += result.statistics.refinement_ms;
    evaluated += static_cast<double>(result.statistics.evaluated);
  }
  const auto n = static_cast<double>(count);
  state.counters["area"] = map.area();
  state.counters["positions"] = static_cast<double>(positions);
  state.counters["index_s"] = localizer.indexBuildSeconds();
  state.counters["index_mb"] = static_cast<double>(localizer.indexBytes()) / 1e6;
  state.counters["search_ms"] = search / n;
  state.counters["refine_ms"] = refinement / n;
  state.counters["evaluated"] = evaluated / n;
  state.counters["right"] = static_cast<double>(right) / n;
}

const int registered = [] {
  for (const int area : {100, 400, 1600}) {
    for (const int percent : {0, 30}) {
      const std::string name =
          "search/" + std::to_string(area) + "m2/" + std::to_string(percent) + "%short";
      benchmark::RegisterBenchmark(
          name.c_str(),
          [area, percent](benchmark::State& state) { searchOnPlan(state, area, percent / 100.0); })
          ->Unit(benchmark::kMillisecond)
          ->Iterations(40);
    }
  }
  return 0;
}();

}  // namespace
}  // namespace mrpt_polyloc
