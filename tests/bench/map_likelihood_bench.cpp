// A particle's weight through MRPT's interface: us of CPU per pose of a scan of 361 beams, for
// CPolygonMap2D beside MRPT's likelihood field on a 0.05 m grid of the same floor, at the same
// decimations; and for many poses in one call.
#include "tests/support/random_maps.h"
#include <mrpt_polyloc/evaluation/WallSegments.h>
#include <mrpt_polyloc/mrpt_bridge/CPolygonMap2D.h>

#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <random>
#include <vector>

namespace mrpt_polyloc {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

/// A furnished floor of 1,500 m2, a scan in it, and where particles are: anywhere at first, within
/// half a metre of the robot once the filter has converged.
struct Scene {
  Scene() : polygons(test::floorPlan(test::furnishedFloor(), 1)), map(polygons) {
    std::mt19937 random(1);
    const TPoint2D p = test::randomFreePoints(polygons, 1, random).front();
    const WallSegments walls(polygons);
    scan.aperture = 3.14159265F;
    scan.maxRange = 80.0F;
    scan.resizeScanAndAssign(361, 1.0F, true);
    for (std::size_t i = 0; i < 361; ++i) {
      const double bearing = (static_cast<double>(i) - 180.0) * 3.14159265 / 360.0;
      scan.setScanRange(i, static_cast<float>(walls.range(p, bearing)));
    }
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const TPoint2D& q : test::randomFreePoints(polygons, 10000, random)) {
      anywhere.emplace_back(q.x, q.y, 3.14 * unit(random));
      converged.emplace_back(p.x + 0.5 * unit(random), p.y + 0.5 * unit(random),
                             0.2 * unit(random));
    }
    const BoundingBox box = polygons.boundingBox();
    grid.setSize(static_cast<float>(box.min.x - 1), static_cast<float>(box.max.x + 1),
                 static_cast<float>(box.min.y - 1), static_cast<float>(box.max.y + 1), 0.05F, 1.0F);
    for (unsigned row = 0; row < grid.getSizeY(); ++row) {
      for (unsigned column = 0; column < grid.getSizeX(); ++column) {
        const TPoint2D center(static_cast<double>(grid.idx2x(static_cast<int>(column))),
                              static_cast<double>(grid.idx2y(static_cast<int>(row))));
        if (walls.distance(center) < 0.036) {
          grid.setCell(static_cast<int>(column), static_cast<int>(row), 0.0F);
        }
      }
    }
    grid.likelihoodOptions.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
    grid.likelihoodOptions.LF_maxCorrsDistance = 0.3F;
    grid.likelihoodOptions.LF_stdHit = 0.2F;
  }

  PolygonMap polygons;
  CPolygonMap2D map;
  COccupancyGridMap2D grid;
  CObservation2DRangeScan scan;
  std::vector<TPose2D> anywhere, converged;
};

Scene& scene() {
  static Scene only;
  return only;
}

template <class Map>
void weighOneByOne(benchmark::State& state, const Map& map, const std::vector<TPose2D>& poses) {
  std::vector<CPose3D> poses3d;
  for (const TPose2D& pose : poses) poses3d.emplace_back(pose);
  std::size_t i = 0;
  double sum = 0.0;
  for (auto _ : state) {
    sum += map.computeObservationLikelihood(scene().scan, poses3d[i]);
    if (++i == poses3d.size()) i = 0;
  }
  benchmark::DoNotOptimize(sum);
}

const std::vector<TPose2D>& posesOf(const benchmark::State& state) {
  return state.range(1) != 0 ? scene().converged : scene().anywhere;
}

void polygonMap(benchmark::State& state) {
  scene().map.likelihoodOptions.decimation = static_cast<unsigned>(state.range(0));
  weighOneByOne(state, scene().map, posesOf(state));
}

void likelihoodField(benchmark::State& state) {
  scene().grid.likelihoodOptions.LF_decimation = static_cast<std::uint32_t>(state.range(0));
  weighOneByOne(state, scene().grid, posesOf(state));
}

/// All poses in one call.
void polygonMapAtOnce(benchmark::State& state) {
  scene().map.likelihoodOptions.decimation = static_cast<unsigned>(state.range(0));
  const std::vector<TPose2D>& poses = posesOf(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(scene().map.computeLikelihoods(scene().scan, poses));
  }
  state.counters["us_per_pose"] = benchmark::Counter(
      1e-6 * static_cast<double>(poses.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// Decimation 1: all 361 beams; 18: 21 of them. Particles anywhere (0), or converged (1).
BENCHMARK(polygonMap)->ArgNames({"decimation", "converged"})->ArgsProduct({{1, 18}, {0, 1}});
BENCHMARK(likelihoodField)->ArgNames({"decimation", "converged"})->ArgsProduct({{1, 18}, {0, 1}});
BENCHMARK(polygonMapAtOnce)->ArgNames({"decimation", "converged"})->ArgsProduct({{1, 18}, {0, 1}});

}  // namespace
}  // namespace mrpt_polyloc
