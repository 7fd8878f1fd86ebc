#include <mrpt_polyloc/geometry/angles.h>
#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/depth_buffer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

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

/// Ranges of the beams in their own order from inverse ranges of the sorted beams.
POLYLOC_HOT_LOOP
void toRanges(const BeamPattern& beams, const float* to_wall, const float* to_open, float* wall,
              float* open) {
  const std::size_t n = beams.size();
  constexpr float kLeast = 1e-30F;  // of inverse ranges; divides where nothing was met
  if (beams.isInOrder()) {
    for (std::size_t i = 0; i < n; ++i) {
      const float range = 1.0F / std::max(to_wall[i], kLeast);
      wall[i] = to_wall[i] > 0.0F ? range : kInfinity;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const float range = 1.0F / std::max(to_open[i], kLeast);
      open[i] = to_open[i] > to_wall[i] ? range : kInfinity;
    }
    return;
  }
  const std::uint32_t* order = beams.order().data();
  for (std::size_t i = 0; i < n; ++i) {
    wall[order[i]] = to_wall[i] > 0.0F ? 1.0F / to_wall[i] : kInfinity;
    open[order[i]] = to_open[i] > to_wall[i] ? 1.0F / to_open[i] : kInfinity;
  }
}

}  // namespace

struct RangePredictor::Workspace {
  DepthWorkspace depths;
  std::vector<float> wall, open;     ///< inverse ranges of the sorted beams
  std::vector<float> along, across;  ///< of the lines that the sorted beams hit
};

RangePredictor::RangePredictor(const Triangulation& triangulation, double cell_size, int threads)
    : box_(triangulation.box()), index_(triangulation, cell_size, threads) {}

/// Calls raise(runs, count, frame, inverse) for the walls and for the open edges that may be seen
/// from a pose; for none outside the triangulated box.
template <class RaiseWalls, class RaiseOpen>
void RangePredictor::forVisible(const mrpt::math::TPose2D& pose, std::int64_t cell,
                                RaiseWalls&& raise_walls, RaiseOpen&& raise_open) const {
  const bool is_known = pose.x >= box_.min.x && pose.x <= box_.max.x && pose.y >= box_.min.y &&
                        pose.y <= box_.max.y && std::isfinite(pose.phi);  // false for NaN
  if (!is_known) return;
  const BoundaryChains& chains = index_.chains();
  const ViewFrame frame = frameOf(pose, chains);
  VisibleEdgeIndex::Cell seen{chains.walls().data(), chains.walls().size(), chains.open().data(),
                              chains.open().size()};
  if (cell >= 0) seen = index_.cell(cell);
  raise_walls(seen.walls, seen.wall_runs, frame);
  raise_open(seen.open, seen.open_runs, frame);
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose, std::int64_t cell,
                             const BeamPattern& beams, Workspace& w, float* wall,
                             float* open) const {
  w.wall.assign(beams.size() + BeamPattern::kPadding, 0.0F);
  w.open.assign(beams.size() + BeamPattern::kPadding, 0.0F);
  const auto raiseInto = [&](std::vector<float>& inverse) {
    return [&](const BoundaryChains::Run* runs, std::size_t count, const ViewFrame& frame) {
      raiseDepths(index_.chains(), runs, count, frame, beams, w.depths, inverse.data());
    };
  };
  forVisible(pose, cell, raiseInto(w.wall), raiseInto(w.open));
  toRanges(beams, w.wall.data(), w.open.data(), wall, open);
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
                             PredictedHits& out) const {
  const std::size_t n = beams.size();
  for (auto* column : {&out.wall, &out.open, &out.along, &out.across}) column->resize(n);
  Workspace& w = workspace();
  for (auto* column : {&w.wall, &w.open, &w.along, &w.across}) {
    column->assign(n + BeamPattern::kPadding, 0.0F);
  }
  const auto raiseWalls = [&](const BoundaryChains::Run* runs, std::size_t count,
                              const ViewFrame& frame) {
    raiseDepths(index_.chains(), runs, count, frame, beams, w.depths,
                HitColumns{w.wall.data(), w.along.data(), w.across.data()});
  };
  const auto raiseOpen = [&](const BoundaryChains::Run* runs, std::size_t count,
                             const ViewFrame& frame) {
    raiseDepths(index_.chains(), runs, count, frame, beams, w.depths, w.open.data());
  };
  forVisible(pose_map_beams, index_.cellNumber({pose_map_beams.x, pose_map_beams.y}), raiseWalls,
             raiseOpen);
  toRanges(beams, w.wall.data(), w.open.data(), out.wall.data(), out.open.data());
  for (std::size_t i = 0; i < n; ++i) {
    out.along[beams.order()[i]] = w.along[i];
    out.across[beams.order()[i]] = w.across[i];
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
  predict(pose_map_beams, index_.cellNumber({pose_map_beams.x, pose_map_beams.y}), beams,
          workspace(), out.wall.data(), out.open.data());
}

void RangePredictor::predict(const std::vector<mrpt::math::TPose2D>& poses,
                             const BeamPattern& beams, PredictedRanges& out) const {
  const std::size_t n = beams.size();
  out.wall.resize(poses.size() * n);
  out.open.resize(poses.size() * n);
  std::vector<std::int64_t> cells(poses.size());
  std::transform(poses.begin(), poses.end(), cells.begin(), [this](const auto& pose) {
    return index_.cellNumber({pose.x, pose.y});
  });
  std::vector<std::size_t> order(poses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::is_sorted(cells.begin(), cells.end())) {
    std::stable_sort(order.begin(), order.end(),
                     [&cells](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
  }
  Workspace& memory = workspace();
  for (const std::size_t i : order) {
    predict(poses[i], cells[i], beams, memory, out.wall.data() + i * n, out.open.data() + i * n);
  }
}

}  // namespace mrpt_polyloc
