#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/evaluation/baselines/LikelihoodLattice.h>
#include <mrpt_polyloc/evaluation/baselines/mrpt_maps.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPosePDF.h>
#include <mrpt/slam/CICP.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace mrpt_polyloc {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::maps::CSimplePointsMap;
using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using mrpt::poses::CPose2D;

/// At most so many hits of a scan, in the beam frame.
CSimplePointsMap pointsOf(const RangeScan& scan, std::size_t most) {
  std::vector<TPoint2D> hits;
  for (const Beam& beam : scan.beams()) {
    if (beam.kind != BeamKind::hit) continue;
    hits.push_back({beam.range * std::cos(beam.bearing), beam.range * std::sin(beam.bearing)});
  }
  CSimplePointsMap points;
  const std::size_t count = std::min(most, hits.size());
  for (std::size_t i = 0; i < count; ++i) {
    const TPoint2D& hit = hits[i * hits.size() / count];
    points.insertPoint(static_cast<float>(hit.x), static_cast<float>(hit.y), 0.0F);
  }
  return points;
}

/// The middles of the occupied cells.
CSimplePointsMap wallPointsOf(const OccupancyBitmap& bitmap) {
  CSimplePointsMap points;
  for (int row = 0; row < bitmap.height; ++row) {
    for (int column = 0; column < bitmap.width; ++column) {
      if (bitmap.at(column, row) != CellState::occupied) continue;
      points.insertPoint(static_cast<float>((column + 0.5) * bitmap.resolution),
                         static_cast<float>((row + 0.5) * bitmap.resolution), 0.0F);
    }
  }
  return points;
}

double likelihood(const COccupancyGridMap2D& grid, const CSimplePointsMap& points,
                  const TPose2D& pose) {
  const CPose2D at(pose);
  return grid.computeLikelihoodField_Thrun(&points, &at);
}

bool areNear(const TPose2D& a, const TPose2D& b, double distance, double angle) {
  return std::hypot(a.x - b.x, a.y - b.y) < distance && angleBetween(a.phi, b.phi) < angle;
}

struct Weighed {
  TPose2D pose;  // of the beams, in the grid's frame
  double value = 0.0;
};

/// The larger value first; where two are alike, an order that does not hang on how they came.
bool isBetter(const Weighed& a, const Weighed& b) {
  return std::tie(b.value, a.pose.phi, a.pose.y, a.pose.x) <
         std::tie(a.value, b.pose.phi, b.pose.y, b.pose.x);
}

/// The best ones, in order, of which no two are near each other.
std::vector<Weighed> bestApart(std::vector<Weighed> poses, std::size_t most, double distance,
                               double angle) {
  std::sort(poses.begin(), poses.end(), isBetter);
  std::vector<Weighed> best;
  for (const Weighed& pose : poses) {
    if (best.size() == most) break;
    const bool is_near = std::any_of(best.begin(), best.end(), [&](const Weighed& other) {
      return areNear(pose.pose, other.pose, distance, angle);
    });
    if (!is_near) best.push_back(pose);
  }
  return best;
}

}  // namespace

void LikelihoodLatticeParams::check() const {
  requirePositive("step", step);
  requireInRange("headings", static_cast<double>(headings), 1.0, 10'000.0);
  requirePositive("sigma", sigma);
  requireInRange("first_hits", static_cast<double>(first_hits), 1.0, 1e6);
  requireInRange("weighed", static_cast<double>(weighed), 1.0, 1e9);
  requireInRange("coarse_hits", static_cast<double>(coarse_hits), 1.0, 1e6);
  requireInRange("fine_hits", static_cast<double>(fine_hits), 1.0, 1e6);
  requireInRange("refined", static_cast<double>(refined), 1.0, 1e6);
  requirePositive("icp_distance", icp_distance);
}

struct LikelihoodLattice::Parts {
  LikelihoodLatticeParams params;
  TPose2D pose_map_grid;
  COccupancyGridMap2D grid;
  std::size_t cells = 0;
  std::vector<TPoint2D> positions;
  CSimplePointsMap walls;  ///< the middles of the occupied cells: what hits are aligned to
  struct Own {
    COccupancyGridMap2D grid;
    CSimplePointsMap walls;
  };
  mutable tbb::enumerable_thread_specific<std::unique_ptr<Own>> own_maps;

  /// The calling thread's.
  const Own& own() const {
    auto& maps = own_maps.local();
    if (!maps) maps = std::make_unique<Own>(Own{grid, walls});
    return *maps;
  }

  std::vector<Weighed> fittingBest(const COccupancyGridMap2D& field, const RangeScan& scan) const;
};

LikelihoodLattice::LikelihoodLattice(const OccupancyBitmap& bitmap,
                                     const LikelihoodLatticeParams& params)
    : parts_(std::make_unique<Parts>()) {
  params.check();
  parts_->params = params;
  parts_->pose_map_grid = bitmap.pose_map_bitmap;
  parts_->cells = bitmap.cells.size();
  parts_->grid = gridOf(bitmap, params.sigma);
  parts_->walls = wallPointsOf(bitmap);
  const double width = bitmap.width * bitmap.resolution;
  const double height = bitmap.height * bitmap.resolution;
  for (double y = 0.5 * params.step; y < height; y += params.step) {
    for (double x = 0.5 * params.step; x < width; x += params.step) {
      const auto column = static_cast<int>(x / bitmap.resolution);
      const auto row = static_cast<int>(y / bitmap.resolution);
      if (bitmap.at(column, row) == CellState::free) parts_->positions.push_back({x, y});
    }
  }
  if (parts_->positions.empty()) throw InvalidMapError("the grid has no free cell on the lattice");
}

LikelihoodLattice::~LikelihoodLattice() = default;

std::size_t LikelihoodLattice::bytes() const {
  return parts_->cells * (sizeof(COccupancyGridMap2D::cellType) + sizeof(double));
}

std::size_t LikelihoodLattice::latticePositions() const {
  return parts_->positions.size();
}

/// The lattice poses that fit best: all are weighed by few hits, the best of them by more.
std::vector<Weighed> LikelihoodLattice::Parts::fittingBest(const COccupancyGridMap2D& field,
                                                           const RangeScan& scan) const {
  const CSimplePointsMap few = pointsOf(scan, params.first_hits);
  const CSimplePointsMap more = pointsOf(scan, params.coarse_hits);
  const double turn = kTwoPi / static_cast<double>(params.headings);
  std::vector<Weighed> lattice;
  lattice.reserve(positions.size() * params.headings);
  for (std::size_t h = 0; h < params.headings; ++h) {
    for (const TPoint2D& position : positions) {
      const TPose2D pose(position.x, position.y, turn * static_cast<double>(h));
      lattice.push_back({pose, likelihood(field, few, pose)});
    }
  }
  if (lattice.size() > params.weighed) {
    const auto end = lattice.begin() + static_cast<std::ptrdiff_t>(params.weighed);
    std::nth_element(lattice.begin(), end, lattice.end(), isBetter);
    lattice.erase(end, lattice.end());
  }
  for (Weighed& pose : lattice) pose.value = likelihood(field, more, pose.pose);
  return bestApart(std::move(lattice), params.refined, 1.1 * params.step, 1.1 * turn);
}

std::vector<BaselineAnswer> LikelihoodLattice::localize(const RangeScan& scan) const {
  if (scan.hitCount() == 0) return {};
  const LikelihoodLatticeParams& params = parts_->params;
  const Parts::Own& own = parts_->own();
  const COccupancyGridMap2D& grid = own.grid;
  const CSimplePointsMap fine = pointsOf(scan, params.fine_hits);

  mrpt::slam::CICP icp;
  icp.options.thresholdDist = params.icp_distance;
  icp.options.smallestThresholdDist = 0.05;
  icp.options.skip_cov_calculation = true;
  std::vector<Weighed> aligned;
  for (const Weighed& start : parts_->fittingBest(grid, scan)) {
    const auto pdf = icp.Align(&own.walls, &fine, CPose2D(start.pose));
    const TPose2D pose = pdf->getMeanVal().asTPose();
    // An alignment that ran away is no better than its start.
    const Weighed moved{pose, likelihood(grid, fine, pose)};
    const Weighed stayed{start.pose, likelihood(grid, fine, start.pose)};
    aligned.push_back(moved.value >= stayed.value ? moved : stayed);
  }

  const CPose2D origin(parts_->pose_map_grid);
  const double most = std::log(static_cast<double>(grid.likelihoodOptions.LF_zHit) +
                               static_cast<double>(grid.likelihoodOptions.LF_zRandom) /
                                   static_cast<double>(grid.likelihoodOptions.LF_maxRange));
  std::vector<BaselineAnswer> answers;
  for (const Weighed& found : bestApart(std::move(aligned), params.refined, 0.2, 4.0 * kDegree)) {
    const TPose2D in_map = (origin + CPose2D(found.pose)).asTPose();
    const double mean = found.value / static_cast<double>(fine.size());
    answers.push_back(
        {scan.robotFromBeamFrame(in_map), std::clamp(std::exp(mean - most), 0.0, 1.0)});
  }
  return answers;
}

}  // namespace mrpt_polyloc
