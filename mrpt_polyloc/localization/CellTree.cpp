#include <mrpt_polyloc/geometry/convex_cells.h>
#include <mrpt_polyloc/geometry/cpu_dispatch.h>
#include <mrpt_polyloc/geometry/errors.h>
#include <mrpt_polyloc/geometry/params_check.h>
#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/morton_code.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace mrpt_polyloc {

/// Arrays of a node with all its bands, near apart from wall; see CellTree::Bands.
struct BandArrays {
  std::array<std::array<std::uint16_t, CellTree::kStride>, 4> values;
};

namespace {

constexpr std::size_t kStride = CellTree::kStride;
constexpr std::size_t kArraysOfWalls = 2, kArraysWithOpen = 4;
/// Array numbers of a node, see CellTree::Bands.
constexpr std::size_t kNearLow = 0, kWallHigh = 1, kNearHigh = 2, kWallLow = 3;
constexpr std::uint16_t kOpenBit = 1;

std::uint16_t roundDown(float range) {
  const double units = std::floor(static_cast<double>(range) * RangeUnits::kPerMeter) - 1.0;
  return static_cast<std::uint16_t>(
      std::clamp(units, 0.0, static_cast<double>(RangeUnits::kGreatest)));
}
/// Up to an even number.
std::uint16_t roundUp(float range) {
  const double units =
      2.0 * std::ceil(0.5 * (static_cast<double>(range) * RangeUnits::kPerMeter + 1.0));
  return static_cast<std::uint16_t>(std::clamp(units, 0.0, 65534.0));
}

void encode(const RangeBands& bands, BandArrays& to) {
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const float near_low = std::min(bands.wall_low[b], bands.open_low[b]);
    const float near_high = std::min(bands.wall_high[b], bands.open_high[b]);
    const bool may_be_open =
        bands.open_low[b] <= bands.wall_high[b] && std::isfinite(bands.open_low[b]);
    to.values[kNearLow][b] = roundDown(near_low);
    to.values[kWallHigh][b] = static_cast<std::uint16_t>(
        (std::isfinite(bands.wall_high[b]) ? roundUp(bands.wall_high[b]) : 65534) |
        (may_be_open ? kOpenBit : 0));
    to.values[kNearHigh][b] =
        std::isfinite(near_high) ? roundUp(near_high) : RangeUnits::kUnbounded;
    to.values[kWallLow][b] = roundDown(bands.wall_low[b]);
  }
}

/// The union of two bands, `from` taken `shift` bins on.
POLYLOC_HOT_LOOP
void widen(const std::uint16_t* __restrict__ from, std::size_t shift, std::size_t which,
           std::uint16_t* __restrict__ to) {
  const bool is_low = which == kNearLow || which == kWallLow;
  const auto join = [&](std::size_t b, std::size_t source) {
    const std::uint16_t a = to[b], c = from[source];
    if (is_low) {
      to[b] = std::min(a, c);
    } else {
      to[b] = std::max(a, c);
      if (which == kWallHigh) {  // the greater one, its bit that of either
        to[b] = static_cast<std::uint16_t>(to[b] | ((a | c) & kOpenBit));
      }
    }
  };
  for (std::size_t b = 0; b + shift < kBandBins; ++b) join(b, b + shift);
  for (std::size_t b = kBandBins - shift; b < kBandBins; ++b) join(b, b + shift - kBandBins);
}

/// Bands over windows twice as wide.
void doubleWindow(std::size_t window, BandArrays& arrays) {
  const BandArrays before = arrays;
  for (std::size_t which = 0; which < kArraysWithOpen; ++which) {
    widen(before.values[which].data(), window, which, arrays.values[which].data());
  }
}

void unite(const BandArrays& from, BandArrays& to) {
  for (std::size_t which = 0; which < kArraysWithOpen; ++which) {
    widen(from.values[which].data(), 0, which, to.values[which].data());
  }
}

/// The bins, and the first ones again to the array's end.
void copyAround(const std::uint16_t* from, std::uint16_t* to) {
  std::copy_n(from, kBandBins, to);
  std::copy_n(from, kStride - kBandBins, to + kBandBins);
}

BoundingBox boxOf(const TPoint2D* vertices, std::size_t count) {
  BoundingBox box{vertices[0], vertices[0]};
  for (std::size_t i = 1; i < count; ++i) {
    box.min = {std::min(box.min.x, vertices[i].x), std::min(box.min.y, vertices[i].y)};
    box.max = {std::max(box.max.x, vertices[i].x), std::max(box.max.y, vertices[i].y)};
  }
  return box;
}

BoundingBox unionOf(const BoundingBox& a, const BoundingBox& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

}  // namespace

void CellTreeParams::check() const {
  requireInRange("cell_size", cell_size, 0.01, 10.0);
  requireInRange("threads", threads, 0.0, 1024.0);
}

CellTree::CellTree(const Triangulation& triangulation, const RangePredictor& predictor,
                   const CellTreeParams& params) {
  params.check();
  data_.cell_size = params.cell_size;
  const BoundingBox& box = triangulation.box();
  constexpr double kMostSquares = 1 << 30;
  if ((box.max.x - box.min.x) * (box.max.y - box.min.y) >
      kMostSquares * params.cell_size * params.cell_size) {
    throw InvalidParamsError("cell_size: " + std::to_string(params.cell_size) +
                             " gives too many cells for a map of this size");
  }
  layOut(predictor.index(), takeCells(triangulation, params.threads));
  fill(predictor, params.threads);
}

CellTree::CellTree(Data data) : data_(std::move(data)) {
  const auto require = [](bool is_met, const char* what) {
    if (!is_met) throw InvalidMapError(std::string("cell tree: bad ") + what);
  };
  const std::size_t cells = data_.levels[0].nodes.size();
  require(data_.cell_size > 0.0, "cell size");
  require(data_.first_vertex.size() == cells + 1 && data_.first_vertex.front() == 0 &&
              data_.first_vertex.back() == data_.vertices.size() &&
              std::is_sorted(data_.first_vertex.begin(), data_.first_vertex.end()),
          "polygons");
  require(data_.first_view.size() == cells, "views");
  for (std::size_t i = 0; i < cells; ++i) {
    const std::size_t end =
        std::size_t{data_.first_view[i]} + (data_.levels[0].nodes[i].has_open != 0 ? 2U : 1U);
    require(end * kStride < data_.views.size(), "views");
    require(polygonSize(i) >= 3, "polygons");
  }
  for (std::size_t level = 0; level < kLevels; ++level) {
    const Level& l = data_.levels[level];
    require(l.boxes.size() == l.nodes.size(), "boxes");
    for (const Node& node : l.nodes) {
      const std::size_t arrays = node.has_open != 0 ? kArraysWithOpen : kArraysOfWalls;
      require((std::size_t{node.first_array} + arrays) * kStride < l.codes.size(), "arrays");
      require(level == 0 || std::size_t{node.first_child} + node.child_count <=
                                data_.levels[level - 1].nodes.size(),
              "children");
    }
  }
}

/// Cells in the order of their blocks.
CellTree::Squares CellTree::takeCells(const Triangulation& triangulation, int threads) {
  const ConvexCells found =
      convexCells(triangulation, triangulation.box().min, data_.cell_size, threads);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    const ConvexCells::Cell& cell = found.cells[i];
    order.emplace_back(
        mortonCode(static_cast<std::uint32_t>(cell.column), static_cast<std::uint32_t>(cell.row)),
        static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end());
  Squares squares;
  data_.vertices.reserve(found.vertices.size());
  for (const auto& [code, i] : order) {
    const ConvexCells::Cell& cell = found.cells[i];
    squares.emplace_back(cell.column, cell.row);
    data_.first_vertex.push_back(static_cast<std::uint32_t>(data_.vertices.size()));
    const auto first = found.vertices.begin() + cell.first;
    data_.vertices.insert(data_.vertices.end(), first, first + cell.count);
    data_.levels[0].boxes.push_back(boxOf(&data_.vertices[data_.first_vertex.back()], cell.count));
  }
  data_.first_vertex.push_back(static_cast<std::uint32_t>(data_.vertices.size()));
  return squares;
}

/// The nodes of all levels, with room for their arrays.
void CellTree::layOut(const VisibleEdgeIndex& index, Squares squares) {
  Squares places = std::move(squares);
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    const std::int64_t number = index.cellNumber(middle(cell));
    const bool has_open = number < 0 || index.cell(number).open_runs > 0;
    data_.levels[0].nodes.push_back({0, 0, 0, has_open ? 1U : 0U});
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const Level& below = data_.levels[level - 1];
    Level& here = data_.levels[level];
    Squares blocks;
    for (std::size_t i = 0; i < below.nodes.size(); ++i) {
      // Level 1 takes squares, of which several cells may lie in one.
      const std::pair<std::int32_t, std::int32_t> block{places[i].first >> 1,
                                                        places[i].second >> 1};
      if (blocks.empty() || blocks.back() != block) {
        blocks.push_back(block);
        here.nodes.push_back({static_cast<std::uint32_t>(i), 0, 0, 0});
        here.boxes.push_back(below.boxes[i]);
      }
      Node& node = here.nodes.back();
      ++node.child_count;
      node.has_open |= below.nodes[i].has_open;
      here.boxes.back() = unionOf(here.boxes.back(), below.boxes[i]);
    }
    places = std::move(blocks);
  }
  for (Level& level : data_.levels) {
    std::uint32_t arrays = 0;
    for (Node& node : level.nodes) {
      node.first_array = arrays;
      arrays += static_cast<std::uint32_t>(node.has_open != 0 ? kArraysWithOpen : kArraysOfWalls);
    }
    level.codes.resize(static_cast<std::size_t>(arrays) * kStride + 1);  // beams read one ahead
  }
  std::uint32_t views = 0;
  for (const Node& node : data_.levels[0].nodes) {
    data_.first_view.push_back(views);
    views += node.has_open != 0 ? 2 : 1;
  }
  data_.views.resize(static_cast<std::size_t>(views) * kStride + 1);
}

void CellTree::storeBands(const BandArrays& arrays, std::size_t level, std::size_t node) {
  Level& l = data_.levels[level];
  const Node& n = l.nodes[node];
  const std::size_t count = n.has_open != 0 ? kArraysWithOpen : kArraysOfWalls;
  for (std::size_t which = 0; which < count; ++which) {
    copyAround(arrays.values[which].data(), &l.codes[(n.first_array + which) * kStride]);
  }
}

void CellTree::storeView(const PredictedRanges& ranges, std::size_t cell) {
  std::array<std::uint16_t, kStride> near{}, wall{};
  const auto in_units = [](float range) {
    return static_cast<std::uint16_t>(
        std::min(range * static_cast<float>(RangeUnits::kPerMeter), 65534.0F));
  };
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const bool is_open = ranges.open[b] < ranges.wall[b];
    near[b] = in_units(std::min(ranges.wall[b], ranges.open[b]));
    wall[b] = static_cast<std::uint16_t>((in_units(ranges.wall[b]) & ~kOpenBit) |
                                         (is_open ? kOpenBit : 0));
  }
  std::uint16_t* to = &data_.views[data_.first_view[cell] * kStride];
  copyAround(wall.data(), to);
  if (data_.levels[0].nodes[cell].has_open != 0) copyAround(near.data(), to + kStride);
}

void CellTree::fill(const RangePredictor& predictor, int threads) {
  std::vector<double> bearings(kBandBins);
  for (std::size_t b = 0; b < kBandBins; ++b) bearings[b] = static_cast<double>(b) * kBandBinWidth;
  const BeamPattern pattern(bearings);
  const auto build = [&](std::size_t first, std::size_t last) {
    RangeBandFinder finder(predictor.index());
    RangeBands bands;
    PredictedRanges ranges;
    // Depth first: what a node hands up is over windows of its own level's width.
    const auto visit = [&](const auto& self, std::size_t level, std::size_t node,
                           BandArrays& arrays) -> void {
      if (level == 0) {
        finder.find(polygon(node), polygonSize(node), bands);
        encode(bands, arrays);
        const TPoint2D p = middle(node);
        predictor.predict({p.x, p.y, 0.0}, pattern, ranges);
        storeView(ranges, node);
      } else {
        const Node& n = data_.levels[level].nodes[node];
        BandArrays child;
        for (std::uint32_t i = 0; i < n.child_count; ++i) {
          self(self, level - 1, n.first_child + i, i == 0 ? arrays : child);
          if (i > 0) unite(child, arrays);
        }
        if (kWindow[level] > kWindow[level - 1]) doubleWindow(kWindow[level - 1], arrays);
      }
      storeBands(arrays, level, node);
    };
    BandArrays arrays;
    for (std::size_t i = first; i < last; ++i) visit(visit, kLevels - 1, i, arrays);
  };
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const tbb::blocked_range<std::size_t> all(0, data_.levels[kLevels - 1].nodes.size(), 4);
    tbb::parallel_for(all, [&](const auto& range) { build(range.begin(), range.end()); });
  });
}

CellTree::Bands CellTree::middleView(std::size_t cell) const {
  const std::uint16_t* wall = &data_.views[data_.first_view[cell] * kStride];
  if (data_.levels[0].nodes[cell].has_open == 0) return {wall, wall, nullptr, nullptr};
  return {wall + kStride, wall, wall + kStride, wall};
}

CellTree::Bands CellTree::bands(std::size_t level, std::size_t node) const {
  const Level& l = data_.levels[level];
  const Node& n = l.nodes[node];
  const std::uint16_t* first = &l.codes[n.first_array * kStride];
  if (n.has_open == 0) return {first, first + kStride, nullptr, nullptr};
  return {first, first + kStride, first + 2 * kStride, first + 3 * kStride};
}

TPoint2D CellTree::middle(std::size_t cell) const {
  const TPoint2D* p = polygon(cell);
  const std::size_t count = polygonSize(cell);
  return std::accumulate(p, p + count, TPoint2D{0, 0}) * (1.0 / static_cast<double>(count));
}

std::size_t CellTree::bytes() const {
  std::size_t sum = data_.vertices.size() * sizeof(TPoint2D) +
                    data_.views.size() * sizeof(std::uint16_t) +
                    data_.first_view.size() * sizeof(std::uint32_t) +
                    data_.first_vertex.size() * sizeof(std::uint32_t);
  for (const Level& level : data_.levels) {
    sum += level.nodes.size() * sizeof(Node) + level.boxes.size() * sizeof(BoundingBox) +
           level.codes.size() * sizeof(std::uint16_t);
  }
  return sum;
}

}  // namespace mrpt_polyloc
