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

void RangePredictor::predictSorted(const mrpt::math::TPose2D& pose, const BeamPattern& beams,
                                   Workspace& w) const {
  w.wall.assign(beams.size(), 0.0F);
  w.open.assign(beams.size(), 0.0F);
  const ViewFrame frame = frameOf(pose, index_.origin());
  const auto fill = [&](const std::vector<VisibleEdgeIndex::Edge>& edges,
                        const std::uint32_t* numbers, std::size_t count, float* inverse) {
    if (count == 0) return;
    projectEdges(edges, numbers, count, frame, w.seen);
    fillDepths(w.seen, beams, inverse);
  };
  const std::int64_t number = index_.cellNumber({pose.x, pose.y});
  if (number >= 0) {
    const VisibleEdgeIndex::Cell cell = index_.cell(number);
    fill(index_.edges(), cell.walls, cell.wall_count, w.wall.data());
    fill(index_.edges(), cell.open, cell.open_count, w.open.data());
    return;
  }
  ViewExpander expander(*triangulation_);
  const View& view = expander.expand({pose.x, pose.y});
  const auto fillPieces = [&](const std::vector<VisibleEdge>& pieces, bool rim, float* inverse) {
    w.edges.clear();
    for (const VisibleEdge& piece : pieces) {
      if (rim && !piece.is_wall) continue;
      const auto& vertices = triangulation_->vertices();
      const TPoint2D a = vertices[static_cast<std::size_t>(piece.right)] - index_.origin();
      const TPoint2D b = vertices[static_cast<std::size_t>(piece.left)] - index_.origin();
      w.edges.push_back({static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(b.x),
                         static_cast<float>(b.y)});
    }
    w.numbers.resize(w.edges.size());
    std::iota(w.numbers.begin(), w.numbers.end(), std::uint32_t{0});
    fill(w.edges, w.numbers.data(), w.numbers.size(), inverse);
  };
  fillPieces(view.ends, true, w.wall.data());
  fillPieces(view.open, false, w.open.data());
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
