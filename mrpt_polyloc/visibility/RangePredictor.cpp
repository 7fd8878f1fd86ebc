#include <mrpt_polyloc/base/angles.h>
#include <mrpt_polyloc/base/cpu_dispatch.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/depth_buffer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ViewFrame frameOf(const mrpt::math::TPose2D& pose, const BoundaryChains& chains) {
  const double heading = std::remainder(pose.phi, kTwoPi);
  return {chains.fixedX(pose.x),
          chains.fixedY(pose.y),
          static_cast<float>(chains.unit()),
          static_cast<float>(heading),
          static_cast<float>(std::cos(heading)),
          static_cast<float>(std::sin(heading))};
}

constexpr float kLeast = 1e-30F;  // of inverse ranges; divides where nothing was met

/// Ranges of the beams in their own order from inverse ranges of the sorted beams.
POLYLOC_HOT_LOOP
void takeWallRanges(const BeamPattern& beams, const float* __restrict__ to_wall,
                    float* __restrict__ wall) {
  const std::size_t n = beams.size();
  if (beams.isInOrder()) {
    for (std::size_t i = 0; i < n; ++i) {
      const float range = 1.0F / std::max(to_wall[i], kLeast);
      wall[i] = to_wall[i] > 0.0F ? range : kInfinity;
    }
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    wall[beams.order()[i]] = to_wall[i] > 0.0F ? 1.0F / to_wall[i] : kInfinity;
  }
}

/// The same for the open edges before the walls; `to_open` is null where there are none.
POLYLOC_HOT_LOOP
void takeOpenRanges(const BeamPattern& beams, const float* __restrict__ to_wall,
                    const float* __restrict__ to_open, float* __restrict__ open) {
  const std::size_t n = beams.size();
  if (to_open == nullptr) {
    std::fill_n(open, n, kInfinity);
    return;
  }
  if (beams.isInOrder()) {
    for (std::size_t i = 0; i < n; ++i) {
      const float range = 1.0F / std::max(to_open[i], kLeast);
      open[i] = to_open[i] > to_wall[i] ? range : kInfinity;
    }
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    open[beams.order()[i]] = to_open[i] > to_wall[i] ? 1.0F / to_open[i] : kInfinity;
  }
}

/// Walls beyond the horizon are not known.
POLYLOC_HOT_LOOP
void endAtHorizon(std::size_t n, float horizon, const float* __restrict__ open,
                  float* __restrict__ wall) {
  for (std::size_t i = 0; i < n; ++i) {
    wall[i] = wall[i] > open[i] + horizon ? kInfinity : wall[i];
  }
}

}  // namespace

struct RangePredictor::Workspace {
  DepthWorkspace depths;
  FloatBlocks wall, open;  ///< inverse ranges of the sorted beams
  HitColumns hits;
  VisibleEdgeIndex::EdgeRuns seen;
};

RangePredictor::RangePredictor(const Triangulation& triangulation, double square_size, int threads,
                               double horizon, BuildProgress* progress)
    : box_(triangulation.box()),
      index_(triangulation, square_size, threads, horizon, progress),
      wall_distances_(triangulation) {}

RangePredictor::RangePredictor(const Triangulation& triangulation, VisibleEdgeIndex::Lists lists)
    : box_(triangulation.box()),
      index_(triangulation, std::move(lists)),
      wall_distances_(triangulation) {}

/// Raises `wall`, inverse ranges or hits, to what is seen from a pose (nothing outside the
/// triangulated box), and writes those to the first open edges to `open` unless that is null; it
/// stays empty where there are none.
template <class Depths>
void RangePredictor::look(const mrpt::math::TPose2D& pose, std::int64_t square,
                          const BeamPattern& beams, Workspace& w, Depths& wall,
                          FloatBlocks* open) const {
  if (open != nullptr) open->assign(0, 0.0F);
  if (!box_.contains({pose.x, pose.y}) || !std::isfinite(pose.phi)) return;
  const BoundaryChains& chains = index_.chains();
  const ViewFrame frame = frameOf(pose, chains);
  index_.take(square, w.seen);
  const auto& walls = w.seen.walls;
  const auto& opens = w.seen.open;
  raiseDepths(chains, walls.data(), walls.size(), frame, beams, w.depths, wall);
  if (open == nullptr || opens.empty()) return;
  open->assign(beams.size(), 0.0F);
  raiseDepths(chains, opens.data(), opens.size(), frame, beams, w.depths, *open);
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose, std::int64_t square,
                             const BeamPattern& beams, Workspace& w, float* wall,
                             float* open) const {
  w.wall.assign(beams.size(), 0.0F);
  look(pose, square, beams, w, w.wall, &w.open);
  takeWallRanges(beams, w.wall.data(), wall);
  takeOpenRanges(beams, w.wall.data(), w.open.data(), open);
  if (w.open.data() != nullptr) {
    endAtHorizon(beams.size(), static_cast<float>(index_.horizon()), open, wall);
  }
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
                             PredictedHits& out) const {
  const std::size_t n = beams.size();
  for (auto* column : {&out.along, &out.across}) column->resize(n);
  Workspace& w = workspace();
  for (auto* column : {&w.hits.inverse, &w.hits.along, &w.hits.across}) column->assign(n, 0.0F);
  look(pose_map_beams, index_.squareNumber({pose_map_beams.x, pose_map_beams.y}), beams, w, w.hits,
       nullptr);
  for (std::size_t i = 0; i < n; ++i) {
    out.along[beams.order()[i]] = w.hits.along[i];
    out.across[beams.order()[i]] = w.hits.across[i];
  }
}

RangePredictor::Workspace& RangePredictor::workspace() {
  thread_local Workspace workspace;
  return workspace;
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
                             PredictedRanges& out) const {
  out.wall.resize(beams.size());
  out.open.resize(beams.size());
  predict(pose_map_beams, index_.squareNumber({pose_map_beams.x, pose_map_beams.y}), beams,
          workspace(), out.wall.data(), out.open.data());
}

void RangePredictor::predict(const std::vector<mrpt::math::TPose2D>& poses,
                             const BeamPattern& beams, PredictedRanges& out) const {
  const std::size_t n = beams.size();
  out.wall.resize(poses.size() * n);
  out.open.resize(poses.size() * n);
  std::vector<std::int64_t> squares(poses.size());
  std::transform(poses.begin(), poses.end(), squares.begin(), [this](const auto& pose) {
    return index_.squareNumber({pose.x, pose.y});
  });
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(squares.begin(), squares.end())) {
    std::stable_sort(order.begin(), order.end(),
                     [&squares](std::size_t a, std::size_t b) { return squares[a] < squares[b]; });
  }
  Workspace& memory = workspace();
  for (const std::size_t i : order) {
    predict(poses[i], squares[i], beams, memory, out.wall.data() + i * n, out.open.data() + i * n);
  }
}

}  // namespace mrpt_polyloc
