#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/base/params_check.h>
#include <mrpt_polyloc/geometry/convex_pieces.h>
#include <mrpt_polyloc/localization/search/QuantizedRange.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/localization/search/morton_code.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

namespace mrpt_polyloc {
namespace {

constexpr std::size_t kStride = SearchTree::kStride;
constexpr std::uint8_t kOpenBit = 1;

/// The finest scale that tells most of a node's ranges.
std::uint16_t scaleOf(const NodeBands& bands) {
  constexpr std::size_t kTold = kBandBins * 97 / 100;
  std::array<float, kBandBins> farthest;
  for (std::size_t b = 0; b < kBandBins; ++b) {
    farthest[b] = std::isfinite(bands[b].wall_high) ? bands[b].wall_high : bands[b].near_low;
  }
  std::nth_element(farthest.begin(), farthest.begin() + kTold, farthest.end());
  std::uint16_t scale = 0;
  while (scale + 1U < QuantizedRange::kScales &&
         static_cast<double>(farthest[kTold]) >
             QuantizedRange::unit(scale) * QuantizedRange::kGreatest) {
    ++scale;
  }
  return scale;
}

/// A bound moved by what its computation in single precision may be off.
double lessened(float range) {
  return static_cast<double>(range) * (1.0 - 1e-5) - 1e-3;
}
double increased(float range) {
  return static_cast<double>(range) * (1.0 + 1e-5) + 1e-3;
}

/// Whether two boxes are the same, and of numbers.
bool areSame(const BoundingBox& a, const BoundingBox& b) {
  return std::isfinite(a.width()) && std::isfinite(a.height()) && a.min == b.min && a.max == b.max;
}

/// Up to an even byte, its lowest bit then saying whether an edge may be open.
std::uint8_t withOpenBit(std::uint8_t even_or_odd, bool may_be_open) {
  const int even = std::min((even_or_odd + 1) / 2 * 2, QuantizedRange::kGreatest - 1);
  return static_cast<std::uint8_t>(even | (may_be_open ? kOpenBit : 0));
}

/// The bins, and the first ones again to the array's end.
template <class T>
void repeat(T* array) {
  std::copy_n(array, kStride - kBandBins, array + kBandBins);
}

}  // namespace

void SearchTreeParams::check() const {
  requireInRange("leaf_size", leaf_size, 0.01, 10.0);
  requireInRange("threads", threads, 0.0, 1024.0);
}

SearchTree::SearchTree(const Triangulation& triangulation, const RangePredictor& predictor,
                       const SearchTreeParams& params, BuildProgress* progress) {
  params.check();
  data_.leaf_size = params.leaf_size;
  const BoundingBox& box = triangulation.box();
  constexpr double kMostSquares = 1 << 30;  // on a side: they are numbered by 32 bits
  if (std::max(box.width(), box.height()) > kMostSquares * params.leaf_size) {
    throw InvalidParamsError("leaf_size: " + formatted("%f", params.leaf_size) +
                             " gives too many leaves for a map of this size");
  }
  layOut(predictor.index(), takeLeaves(triangulation, params.threads));
  fill(predictor, params.threads, progress);
}

SearchTree::SearchTree(Data data) : data_(std::move(data)) {
  const auto require = [](bool is_met, const char* what) {
    if (!is_met) throw InvalidMapError(std::string("search tree: bad ") + what);
  };
  const std::size_t leaves = data_.levels[0].nodes.size();
  require(data_.leaf_size > 0.0, "leaf size");
  require(data_.first_vertex.size() == leaves + 1 && data_.first_vertex.front() == 0 &&
              data_.first_vertex.back() == data_.vertices.size() &&
              std::is_sorted(data_.first_vertex.begin(), data_.first_vertex.end()),
          "polygons");
  require(data_.first_view.size() == leaves + 1 && data_.first_view.front() == 0 &&
              data_.views.size() == data_.first_view.back() * kStride + 1,
          "views");
  for (std::size_t i = 0; i < leaves; ++i) {
    require(polygonSize(i) >= 3, "polygons");
    const std::uint32_t arrays = data_.first_view[i + 1] - data_.first_view[i];
    require(arrays == 1 || arrays == 2, "views");
  }
  for (std::size_t level = 0; level < kLevels; ++level) {
    const Level& l = data_.levels[level];
    require(l.boxes.size() == l.nodes.size(), "boxes");
    require(l.codes.size() == l.nodes.size() * kArrays * kStride + 1, "arrays");
    for (const Node& node : l.nodes) require(node.scale < QuantizedRange::kScales, "scale");
  }
  for (std::size_t i = 0; i < leaves; ++i) {
    const TPoint2D* const end = polygon(i) + polygonSize(i);
    BoundingBox around = BoundingBox::empty();
    for (const TPoint2D* p = polygon(i); p != end; ++p) {
      require(box(0, i).contains(*p), "polygons");  // around leaves out what is not a number
      around.include(*p);
    }
    require(areSame(around, box(0, i)), "boxes");
  }
  // Each node is a child once: a file could make a descent without end of children that are shared.
  for (std::size_t level = 1; level < kLevels; ++level) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < nodes(level).size(); ++i) {
      const Node& node = nodes(level)[i];
      require(node.first_child == end && node.child_count > 0 &&
                  node.child_count <= nodes(level - 1).size() - end,
              "children");
      BoundingBox around = BoundingBox::empty();
      for (const std::size_t stop = end + node.child_count; end < stop; ++end) {
        around.include(box(level - 1, end));
      }
      require(areSame(around, box(level, i)), "boxes");
    }
    require(end == nodes(level - 1).size(), "children");
  }
}

/// Leaves in the order of their blocks.
SearchTree::Squares SearchTree::takeLeaves(const Triangulation& triangulation, int threads) {
  const ConvexPieces found =
      convexPieces(triangulation, triangulation.box().min, data_.leaf_size, threads);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::size_t i = 0; i < found.pieces.size(); ++i) {
    const ConvexPieces::Piece& leaf = found.pieces[i];
    order.emplace_back(
        mortonCode(static_cast<std::uint32_t>(leaf.column), static_cast<std::uint32_t>(leaf.row)),
        static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end());
  Squares squares;
  data_.vertices.reserve(found.vertices.size());
  for (const auto& [code, i] : order) {
    const ConvexPieces::Piece& leaf = found.pieces[i];
    squares.emplace_back(leaf.column, leaf.row);
    data_.first_vertex.push_back(static_cast<std::uint32_t>(data_.vertices.size()));
    const auto first = found.vertices.begin() + leaf.first;
    data_.vertices.insert(data_.vertices.end(), first, first + leaf.count);
    data_.levels[0].boxes.push_back(BoundingBox::empty());
    std::for_each(first, first + leaf.count,
                  [this](const TPoint2D& p) { data_.levels[0].boxes.back().include(p); });
  }
  data_.first_vertex.push_back(static_cast<std::uint32_t>(data_.vertices.size()));
  return squares;
}

/// The nodes of all levels, with room for their arrays.
void SearchTree::layOut(const VisibleEdgeIndex& index, Squares squares) {
  Squares places = std::move(squares);
  data_.first_view.push_back(0);
  for (std::size_t leaf = 0; leaf < places.size(); ++leaf) {
    const std::int64_t number = index.squareNumber(middle(leaf));
    const bool has_open = index.seesOpen(number);
    data_.first_view.push_back(data_.first_view.back() + (has_open ? 2 : 1));
    data_.levels[0].nodes.push_back({0, 0, static_cast<std::uint16_t>(has_open ? 1 : 0), 0});
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const Level& below = data_.levels[level - 1];
    Level& here = data_.levels[level];
    Squares blocks;
    for (std::size_t i = 0; i < below.nodes.size(); ++i) {
      // Level 1 takes squares, of which several leaves may lie in one.
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
      here.boxes.back().include(below.boxes[i]);
    }
    places = std::move(blocks);
  }
  for (Level& level : data_.levels) {
    level.codes.resize(level.nodes.size() * kArrays * kStride + 1);  // beams read one ahead
  }
  data_.views.resize(data_.first_view.back() * kStride + 1);
}

void SearchTree::storeBands(const NodeBands& bands, std::size_t level, std::size_t node) {
  Level& l = data_.levels[level];
  Node& n = l.nodes[node];
  n.scale = scaleOf(bands);
  std::uint8_t* const near_low = &l.codes[node * kArrays * kStride];
  std::uint8_t* const wall_high = near_low + kStride;
  std::uint8_t* const gap_low = wall_high + kStride;
  std::uint8_t* const gap_high = gap_low + kStride;
  for (std::size_t b = 0; b < kBandBins; ++b) {
    const BinBand& band = bands[b];
    near_low[b] = QuantizedRange::down(lessened(band.near_low), n.scale);
    wall_high[b] = QuantizedRange::up(increased(band.wall_high), n.scale);
    const std::uint8_t low = band.hasGap() ? QuantizedRange::up(increased(band.gap_low), n.scale)
                                           : QuantizedRange::kGreatest;
    gap_low[b] = withOpenBit(low, band.may_be_open);
    gap_high[b] = band.hasGap() ? QuantizedRange::down(lessened(band.gap_high), n.scale) : 0;
    // What begins beyond the greatest byte is no gap: rounded to an even byte, it would begin
    // below.
    if (gap_high[b] <= gap_low[b] || low == QuantizedRange::kGreatest) gap_high[b] = 0;
  }
  for (std::size_t array = 0; array < kArrays; ++array) repeat(near_low + array * kStride);
}

void SearchTree::storeView(const PredictedRanges& ranges, std::size_t leaf) {
  std::uint16_t* const near = &data_.views[data_.first_view[leaf] * kStride];
  const auto in_units = [](float range) {
    constexpr double kMost = 65535.0;
    return static_cast<std::uint16_t>(std::min(static_cast<double>(range) / kViewUnit, kMost));
  };
  for (std::size_t b = 0; b < kBandBins; ++b) {
    near[b] = in_units(std::min(ranges.wall[b], ranges.open[b]));
  }
  repeat(near);
  if (data_.first_view[leaf + 1] - data_.first_view[leaf] == 1) return;  // near is wall
  std::uint16_t* const wall = near + kStride;
  for (std::size_t b = 0; b < kBandBins; ++b) wall[b] = in_units(ranges.wall[b]);
  repeat(wall);
}

void SearchTree::fill(const RangePredictor& predictor, int threads, BuildProgress* progress) {
  std::vector<double> bearings(kBandBins);
  for (std::size_t b = 0; b < kBandBins; ++b) bearings[b] = static_cast<double>(b) * kBandBinWidth;
  const BeamPattern pattern(bearings);
  const auto build = [&](std::size_t first, std::size_t last) {
    RangeBandFinder finder(predictor.index());
    RangeBands ranges_of_leaf;
    PredictedRanges view;
    // Depth first: what a node hands up is over windows of its own level's width.
    const auto visit = [&](const auto& self, std::size_t level, std::size_t node,
                           NodeBands& bands) -> void {
      std::size_t window = 1;
      if (level == 0) {
        finder.find(polygon(node), polygonSize(node), ranges_of_leaf);
        bandsOfLeaf(ranges_of_leaf, predictor.index().horizon(), bands);
      } else {
        const Node& n = data_.levels[level].nodes[node];
        if (level == 1 && n.child_count > 1) finder.narrow(box(level, node));
        NodeBands child;
        for (std::uint32_t i = 0; i < n.child_count; ++i) {
          self(self, level - 1, n.first_child + i, i == 0 ? bands : child);
          if (i > 0) unite(child, 0, bands);
        }
        window = kWindow[level - 1];
      }
      for (; window < kWindow[level]; window *= 2) doubleWindow(window, bands);
      storeBands(bands, level, node);
      if (level > 0) return;
      const TPoint2D p = middle(node);
      predictor.predict({p.x, p.y, 0.0}, pattern, view);
      storeView(view, node);
    };
    NodeBands bands;
    for (std::size_t i = first; i < last; ++i) visit(visit, kLevels - 1, i, bands);
  };
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const tbb::blocked_range<std::size_t> all(0, data_.levels[kLevels - 1].nodes.size(), 4);
    if (progress != nullptr) progress->begin(all.end());
    tbb::parallel_for(all, [&](const auto& range) {
      build(range.begin(), range.end());
      if (progress != nullptr) progress->take(range.size());
    });
  });
}

SearchTree::View SearchTree::middleView(std::size_t leaf) const {
  const std::uint16_t* near = &data_.views[data_.first_view[leaf] * kStride];
  const std::size_t arrays = data_.first_view[leaf + 1] - data_.first_view[leaf];
  return {near, near + (arrays - 1) * kStride};
}

SearchTree::Bands SearchTree::bands(std::size_t level, std::size_t node) const {
  const Level& l = data_.levels[level];
  const Node& n = l.nodes[node];
  const std::uint8_t* first = &l.codes[node * kArrays * kStride];
  return {first,   first + kStride, first + 2 * kStride, first + 3 * kStride,
          n.scale, n.has_open != 0};
}

TPoint2D SearchTree::middle(std::size_t leaf) const {
  const TPoint2D* p = polygon(leaf);
  const std::size_t count = polygonSize(leaf);
  return std::accumulate(p, p + count, TPoint2D{0, 0}) * (1.0 / static_cast<double>(count));
}

std::size_t SearchTree::bytes() const {
  std::size_t sum = data_.vertices.size() * sizeof(TPoint2D) +
                    data_.views.size() * sizeof(std::uint16_t) +
                    (data_.first_vertex.size() + data_.first_view.size()) * sizeof(std::uint32_t);
  for (const Level& level : data_.levels) {
    sum += level.nodes.size() * sizeof(Node) + level.boxes.size() * sizeof(BoundingBox) +
           level.codes.size();
  }
  return sum;
}

}  // namespace mrpt_polyloc
