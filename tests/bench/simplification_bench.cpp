/// Simplification of traced borders: ours against CGAL's Polyline_simplification_2 with the same
/// tolerance. Counter: points left.
#include "tests/support/noisy_grid.h"
#include <mrpt_polyloc/geometry/chain_simplification.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>
#include <benchmark/benchmark.h>

#include <vector>

namespace mrpt_polyloc::test {
namespace {

namespace simplification = CGAL::Polyline_simplification_2;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = simplification::Vertex_base_2<Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<Delaunay>;

constexpr double kToleranceCells = 1.0;

BorderChains bordersOf(const OccupancyBitmap& bitmap) {
  return traceBorders(labelRegions(bitmap, 100.0, 0.0));
}

void simplifyOurs(benchmark::State& state) {
  const OccupancyBitmap bitmap =
      noisyGrid(static_cast<int>(state.range(0)), static_cast<int>(state.range(0)), 1);
  const BorderChains borders = bordersOf(bitmap);
  std::size_t points = 0;
  for (auto _ : state) {
    points = simplifyChains(borders, bitmap.width, bitmap.height, kToleranceCells).points.size();
  }
  state.counters["points"] = static_cast<double>(points);
}

void simplifyCgal(benchmark::State& state) {
  const OccupancyBitmap bitmap =
      noisyGrid(static_cast<int>(state.range(0)), static_cast<int>(state.range(0)), 1);
  const BorderChains borders = bordersOf(bitmap);
  std::size_t points = 0;
  for (auto _ : state) {
    Triangulation triangulation;
    for (const BorderChain& chain : borders.chains) {
      std::vector<Kernel::Point_2> polyline;
      for (std::size_t i = chain.begin; i < chain.end; ++i) {
        polyline.emplace_back(borders.points[i].x, borders.points[i].y);
      }
      triangulation.insert_constraint(polyline.begin(), polyline.end());
    }
    const double tolerance = kToleranceCells * kLatticePerCell;
    simplification::simplify(triangulation, simplification::Squared_distance_cost(),
                             simplification::Stop_above_cost_threshold(tolerance * tolerance));
    points = 0;
    for (auto c = triangulation.constraints_begin(); c != triangulation.constraints_end(); ++c) {
      for (auto v = triangulation.vertices_in_constraint_begin(*c);
           v != triangulation.vertices_in_constraint_end(*c); ++v) {
        ++points;
      }
    }
  }
  state.counters["points"] = static_cast<double>(points);
}

BENCHMARK(simplifyOurs)->Arg(500)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);
BENCHMARK(simplifyCgal)->Arg(500)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mrpt_polyloc::test
