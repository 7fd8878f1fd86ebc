#pragma once

#include <mrpt_polyloc/base/BuildProgress.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/localization/search/NodeBands.h>
#include <mrpt_polyloc/localization/search/RangeBands.h>
#include <mrpt_polyloc/visibility/RangePredictor.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

struct SearchTreeParams {
  /// Side of the squares of the finest level [m]. Bounds get tighter, memory and time of building
  /// grow with its inverse square. The index of visible edges must have squares of four times this
  /// size.
  double leaf_size = 0.25;
  int threads = 0;  ///< 0: all cores

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// The index of the certified search: free space cut into convex leaves, each with its range bands,
/// and above them a tree of square blocks, each twice as wide as those below, that hold all that
/// their leaves hold, over wider windows of headings.
///
/// On level l a block is 2^l leaf sizes wide, and its bands are over kWindow[l] bins: entry b
/// bounds what is seen in the bins b to b + kWindow[l] - 1. Level 0 holds the leaves themselves.
class SearchTree {
 public:
  static constexpr std::size_t kLevels = 4;
  /// [bins]; each divides kBandBins. On level 0 a turn by the window moves what is seen about as
  /// much as a way across the leaf does.
  static constexpr std::array<std::size_t, kLevels> kWindow = {2, 2, 4, 4};
  /// Entries of an array: the bins, and the first ones again, for whole vectors and windows that
  /// begin at any bin.
  static constexpr std::size_t kStride = 192;
  static constexpr std::size_t kArrays = 4;       ///< of a node, see Bands
  static constexpr double kViewUnit = 1.0 / 128;  ///< [m]

  struct Node {
    std::uint32_t first_child, child_count;  ///< in the level below; unused on level 0
    std::uint16_t has_open;                  ///< 1: an open edge may be seen
    std::uint16_t scale;                     ///< of QuantizedRange
  };
  struct Level {
    std::vector<Node> nodes;
    std::vector<BoundingBox> boxes;
    std::vector<std::uint8_t> codes;  ///< the nodes' arrays, and one entry more
  };
  /// All that a tree is made of, to be stored.
  struct Data {
    double leaf_size = 0.0;                   ///< [m]
    std::vector<TPoint2D> vertices;           ///< of the leaves' polygons
    std::vector<std::uint32_t> first_vertex;  ///< of each leaf, and the end
    std::array<Level, kLevels> levels;
    std::vector<std::uint32_t> first_view;  ///< array of each leaf in `views`, and the end
    /// Of each leaf near and, where it may see open edges, wall; and one entry more.
    std::vector<std::uint16_t> views;
  };

  /// A BinBand of each bin, as QuantizedRange of a scale. In a node that sees open edges the lowest
  /// bit of gap_low tells where one may come before the wall.
  struct Bands {
    const std::uint8_t *near_low, *wall_high, *gap_low, *gap_high;
    std::size_t scale;
    bool has_open;
  };

  /// What is predicted from the middle of a leaf in the directions where the bins begin
  /// [kViewUnit]: the range to the first wall, and to an open edge if that comes before.
  struct View {
    const std::uint16_t *near, *wall;
  };

  /// \param predictor its index over squares of four times the leaf size
  /// \throws InvalidParamsError, CancelledError
  SearchTree(const Triangulation& triangulation, const RangePredictor& predictor,
             const SearchTreeParams& params = {}, BuildProgress* progress = nullptr);

  /// \throws InvalidMapError unless all numbers in the data are in their ranges, each node is the
  ///     child of one, and the boxes are those of what they hold
  explicit SearchTree(Data data);

  const Data& data() const { return data_; }
  double leafSize() const { return data_.leaf_size; }
  const std::vector<Node>& nodes(std::size_t level) const { return data_.levels[level].nodes; }
  Bands bands(std::size_t level, std::size_t node) const;

  /// The box that holds a node: the smallest one around a leaf, and around its leaves [m].
  const BoundingBox& box(std::size_t level, std::size_t node) const {
    return data_.levels[level].boxes[node];
  }
  /// The vertices of a leaf, counterclockwise [m].
  const TPoint2D* polygon(std::size_t leaf) const {
    return &data_.vertices[data_.first_vertex[leaf]];
  }
  std::size_t polygonSize(std::size_t leaf) const {
    return data_.first_vertex[leaf + 1] - data_.first_vertex[leaf];
  }
  /// The mean of its vertices [m].
  TPoint2D middle(std::size_t leaf) const;
  View middleView(std::size_t leaf) const;

  std::size_t bytes() const;

 private:
  using Squares = std::vector<std::pair<std::int32_t, std::int32_t>>;  ///< (column, row)
  Squares takeLeaves(const Triangulation& triangulation, int threads);
  void layOut(const VisibleEdgeIndex& index, Squares squares);
  void fill(const RangePredictor& predictor, int threads, BuildProgress* progress);
  void storeBands(const NodeBands& bands, std::size_t level, std::size_t node);
  void storeView(const PredictedRanges& ranges, std::size_t leaf);

  Data data_;
};

}  // namespace mrpt_polyloc
