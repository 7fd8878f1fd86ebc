#include <mrpt_polyloc/visibility/RangePredictor.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>
#include <mrpt_polyloc/visibility/depth_buffer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace mrpt_polyloc {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

ViewFrame frameOf(const mrpt::math::TPose2D& pose, const TPoint2D& origin) {
  const double heading = std::remainder(pose.phi, 2.0 * 3.14159265358979323846);
  return {static_cast<float>(pose.x - origin.x), static_cast<float>(pose.y - origin.y),
          static_cast<float>(heading), static_cast<float>(std::cos(heading)),
          static_cast<float>(std::sin(heading))};
}

}  // namespace

struct RangePredictor::Workspace {
  SeenEdges seen;
  std::vector<float> wall, open;  ///< inverse ranges of the sorted beams
  // For poses that no cell covers:
  std::vector<VisibleEdgeIndex::Edge> edges;
  std::vector<std::uint32_t> numbers;
};

RangePredictor::RangePredictor(const Triangulation& triangulation, double cell_size, int threads)
    : triangulation_(&triangulation), index_(triangulation, cell_size, threads) {}

/// Projects the walls, then the open edges that may be seen from the pose into workspace.seen, and
/// calls fill_walls() and fill_open() after each.
template <class FillWalls, class FillOpen>
void RangePredictor::projectVisible(const mrpt::math::TPose2D& pose, Workspace& w,
                                    FillWalls&& fill_walls, FillOpen&& fill_open) const {
  const ViewFrame frame = frameOf(pose, index_.origin());
  const std::int64_t number = index_.cellNumber({pose.x, pose.y});
  if (number >= 0) {
    const VisibleEdgeIndex::Cell cell = index_.cell(number);
    projectEdges(index_.edges(), cell.walls, cell.wall_count, frame, w.seen);
    fill_walls();
    projectEdges(index_.edges(), cell.open, cell.open_count, frame, w.seen);
    fill_open();
    return;
  }
  ViewExpander expander(*triangulation_);
  const View& view = expander.expand({pose.x, pose.y});
  const auto project = [&](const std::vector<VisibleEdge>& pieces, bool walls_only) {
    w.edges.clear();
    for (const VisibleEdge& piece : pieces) {
      if (walls_only && !piece.is_wall) continue;
      const auto& vertices = triangulation_->vertices();
      const TPoint2D a = vertices[static_cast<std::size_t>(piece.right)] - index_.origin();
      const TPoint2D b = vertices[static_cast<std::size_t>(piece.left)] - index_.origin();
      w.edges.push_back({static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                         static_cast<float>(b.y)});
    }
    w.numbers.resize(w.edges.size());
    std::iota(w.numbers.begin(), w.numbers.end(), std::uint32_t{0});
    projectEdges(w.edges, w.numbers.data(), w.numbers.size(), frame, w.seen);
  };
  project(view.ends, true);
  fill_walls();
  project(view.open, false);
  fill_open();
}

void RangePredictor::predictSorted(const mrpt::math::TPose2D& pose, const BeamPattern& beams,
                                   Workspace& w) const {
  w.wall.assign(beams.size(), 0.0F);
  w.open.assign(beams.size(), 0.0F);
  projectVisible(
      pose, w, [&] { fillDepths(w.seen, beams, w.wall.data()); },
      [&] { fillDepths(w.seen, beams, w.open.data()); });
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
                             PredictedHits& out) const {
  const std::size_t n = beams.size();
  for (auto* column : {&out.wall, &out.open, &out.along, &out.across}) column->resize(n);
  Workspace w;
  w.wall.assign(n, 0.0F);
  w.open.assign(n, 0.0F);
  std::vector<std::int32_t> nearest(n, -1);
  std::vector<float> along(n, 0.0F), across(n, 0.0F);
  const auto fillWalls = [&] {
    fillDepths(w.seen, beams, w.wall.data(), nearest.data());
    for (std::size_t i = 0; i < n; ++i) {
      if (nearest[i] < 0) continue;
      along[i] = w.seen.along[static_cast<std::size_t>(nearest[i])];
      across[i] = w.seen.across[static_cast<std::size_t>(nearest[i])];
    }
  };
  projectVisible(pose_map_beams, w, fillWalls, [&] { fillDepths(w.seen, beams, w.open.data()); });
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t beam = beams.order()[i];
    out.wall[beam] = w.wall[i] > 0.0F ? 1.0F / w.wall[i] : kInfinity;
    out.open[beam] = w.open[i] > w.wall[i] ? 1.0F / w.open[i] : kInfinity;
    out.along[beam] = along[i];
    out.across[beam] = across[i];
  }
}

void RangePredictor::predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
                             PredictedRanges& out) const {
  predict(std::vector<mrpt::math::TPose2D>{pose_map_beams}, beams, out);
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
  Workspace workspace;
  for (const std::size_t pose : order) {
    predictSorted(poses[pose], beams, workspace);
    float* wall = out.wall.data() + pose * n;
    float* open = out.open.data() + pose * n;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t beam = beams.order()[i];
      const float to_wall = workspace.wall[i], to_open = workspace.open[i];
      wall[beam] = to_wall > 0.0F ? 1.0F / to_wall : kInfinity;
      open[beam] = to_open > to_wall ? 1.0F / to_open : kInfinity;
    }
  }
}

}  // namespace mrpt_polyloc
