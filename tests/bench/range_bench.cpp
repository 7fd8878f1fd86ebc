// Range prediction: us per pose of 360 beams against MRPT's laserScanSimulator in the same run
// (counter `ratio`), and on real maps where POLYLOC_DATA is set.
#include "tests/support/data_dir.h"
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/io/map_files.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>

#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::math::TPose2D;

std::vector<double> fan(std::size_t beams, double field_of_view) {
  std::vector<double> bearings(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    bearings[i] = field_of_view * (static_cast<double>(i) / static_cast<double>(beams) - 0.5);
  }
  return bearings;
}

/// CPU time, so that a busy machine does not count.
double secondsOf(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Random poses in free space, sorted by the predictor's cells.
std::vector<TPose2D> sortedPoses(const Triangulation& triangulation,
                                 const RangePredictor& predictor, std::size_t count) {
  std::mt19937 random(1);
  const BoundingBox& box = triangulation.box();
  std::uniform_real_distribution<double> x(box.min.x, box.max.x), y(box.min.y, box.max.y);
  std::uniform_real_distribution<double> heading(-kPi, kPi);
  std::vector<TPose2D> poses;
  while (poses.size() < count) {
    const TPoint2D p(x(random), y(random));
    if (triangulation.isFree(p)) poses.emplace_back(p.x, p.y, heading(random));
  }
  std::sort(poses.begin(), poses.end(), [&](const TPose2D& a, const TPose2D& b) {
    return predictor.index().squareNumber({a.x, a.y}) < predictor.index().squareNumber({b.x, b.y});
  });
  return poses;
}

/// The same map as cells of 0.05 m: free where the cell's centre is.
mrpt::maps::COccupancyGridMap2D rasterise(const Triangulation& triangulation) {
  constexpr float kResolution = 0.05F;
  const BoundingBox& box = triangulation.box();
  mrpt::maps::COccupancyGridMap2D grid;
  grid.setSize(static_cast<float>(box.min.x), static_cast<float>(box.max.x),
               static_cast<float>(box.min.y), static_cast<float>(box.max.y), kResolution);
  for (unsigned row = 0; row < grid.getSizeY(); ++row) {
    for (unsigned column = 0; column < grid.getSizeX(); ++column) {
      const TPoint2D center(grid.idx2x(column), grid.idx2y(row));
      grid.setCell(static_cast<int>(column), static_cast<int>(row),
                   triangulation.isFree(center) ? 1.0F : 0.0F);
    }
  }
  return grid;
}

/// Seconds per pose of MRPT's simulator, over some of the poses.
double mrptSecondsPerPose(const Triangulation& triangulation, const std::vector<TPose2D>& poses) {
  const mrpt::maps::COccupancyGridMap2D grid = rasterise(triangulation);
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(2 * kPi);
  scan.maxRange = 80.0F;
  const std::size_t step = std::max<std::size_t>(1, poses.size() / 2000);
  std::size_t count = 0;
  const double seconds = secondsOf([&] {
    for (std::size_t i = 0; i < poses.size(); i += step, ++count) {
      grid.laserScanSimulator(scan, mrpt::poses::CPose2D(poses[i]), 0.5F, 360);
      benchmark::DoNotOptimize(scan.getScanRange(0));
    }
  });
  return seconds / static_cast<double>(count);
}

double meanListLength(const RangePredictor& predictor, const std::vector<TPose2D>& poses) {
  std::size_t sum = 0;
  for (const TPose2D& pose : poses) {
    const auto cell = predictor.index().edgeRuns(predictor.index().squareNumber({pose.x, pose.y}));
    for (const auto& run : cell.walls) sum += run.edges;
    for (const auto& run : cell.open) sum += run.edges;
  }
  return static_cast<double>(sum) / static_cast<double>(poses.size());
}

/// What expanding the view itself costs and finds, for comparison, over some of the poses.
void measureExpansion(benchmark::State& state, const Triangulation& triangulation,
                      const std::vector<TPose2D>& poses) {
  ViewExpander expander(triangulation);
  std::size_t sum = 0, count = 0;
  const double seconds = secondsOf([&] {
    for (std::size_t i = 0; i < poses.size(); i += 100, ++count) {
      const View& view = expander.expand({poses[i].x, poses[i].y});
      sum += view.ends.size() + view.open.size();
    }
  });
  state.counters["pieces_seen"] = static_cast<double>(sum) / static_cast<double>(count);
  state.counters["expand_us"] = 1e6 * seconds / static_cast<double>(count);
}

void predictPoses(benchmark::State& state, const PolygonMap& map, std::size_t beams,
                  bool against_mrpt) {
  double triangulate = 0, build = 0;
  std::unique_ptr<Triangulation> triangulation;
  triangulate = secondsOf([&] { triangulation = std::make_unique<Triangulation>(map); });
  std::unique_ptr<RangePredictor> predictor;
  build = secondsOf([&] {
    predictor = std::make_unique<RangePredictor>(*triangulation, RangePredictor::kSquareSize, 1);
  });
  const std::vector<TPose2D> poses = sortedPoses(*triangulation, *predictor, 10000);
  const BeamPattern pattern(fan(beams, beams == 360 ? 2 * kPi : kPi));
  PredictedRanges out;
  double best = 1e9;  // of the runs: what disturbs makes it slower only
  for (auto _ : state) {
    best = std::min(best, secondsOf([&] { predictor->predict(poses, pattern, out); }));
    benchmark::DoNotOptimize(out.wall.data());
  }
  const double per_pose = best / static_cast<double>(poses.size());
  state.counters["us_per_pose"] = 1e6 * per_pose;
  state.counters["n"] = static_cast<double>(map.vertexCount());
  state.counters["m2"] = map.area();
  state.counters["listed"] = meanListLength(*predictor, poses);
  measureExpansion(state, *triangulation, poses);
  state.counters["triangulate_s"] = triangulate;
  state.counters["index_s"] = build;
  state.counters["index_MB"] = static_cast<double>(predictor->index().bytes()) / 1e6;
  if (against_mrpt) {
    const double mrpt = mrptSecondsPerPose(*triangulation, poses);
    state.counters["mrpt_us"] = 1e6 * mrpt;
    state.counters["ratio"] = mrpt / per_pose;
  }
}

void predictOnPlan(benchmark::State& state, const test::FloorPlanParams& params) {
  predictPoses(state, test::floorPlan(params, 1), 360, true);
}

void predictOnSet(benchmark::State& state, const std::string& file, std::size_t beams) {
  predictPoses(state, loadMap(file).map, beams, false);
}

const int registered = [] {
  const auto add = [](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  const auto plan = [&add](const std::string& name, const test::FloorPlanParams& params) {
    add("range/" + name, [params](benchmark::State& state) { predictOnPlan(state, params); });
  };
  plan("small_flat", test::smallFlat());
  plan("large_floor", test::largeFloor());
  plan("furnished_floor", test::furnishedFloor());
  plan("noisy_floor", test::noisyFloor());
  if (const auto data = test::dataDir()) {
    for (const std::string& set :
         std::vector<std::string>{"intel", "fr079", "csail", "aces", "malaga_fac"}) {
      for (const std::size_t beams : {180U, 360U}) {
        add("range/" + set + "/" + std::to_string(beams),
            [file = *data + "/scans/" + set + "/map.yaml", beams](benchmark::State& state) {
              predictOnSet(state, file, beams);
            });
      }
    }
  }
  return 0;
}();

}  // namespace
}  // namespace mrpt_polyloc
