#pragma once

#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>

#include <mrpt/math/TPoint2D.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace mrpt_polyloc {

/// The way down a SearchTree, from some blocks of its top level, with a limit that rises: nodes
/// bounded above the limit wait until it reaches them, so that nothing is done twice; what the
/// prior does not allow is left out.
class TreeDescent {
 public:
  /// A node of the tree and a window of headings, the first bin of which is `heading`.
  struct Node {
    std::uint32_t index;
    std::uint32_t heading;
    unsigned bound;  ///< of the search cost [units of the query]
  };

  static constexpr std::size_t kBuckets = 33;  ///< bits of a bound

  /// Nodes of one level, [first, last).
  struct Range {
    std::uint32_t first, last;
    std::size_t size() const { return last - first; }
  };

  /// Memory that is kept from one descent to the next: growing it again takes a tenth of the time.
  struct Workspace {
    /// Above the limit, by level and by the bits of the bound: as the limit rises, whole vectors
    /// come within it.
    std::array<std::array<std::vector<Node>, kBuckets>, SearchTree::kLevels> waiting;
    std::array<std::vector<Node>, SearchTree::kLevels> within;  ///< to be expanded, by level
    std::vector<std::uint32_t> headings;  ///< allowed windows that are to be bounded
    std::vector<unsigned> bounds;         ///< of these
    std::vector<Node> grouped;
    std::vector<std::uint32_t> first_of_index;
  };

  /// Bounds the blocks, nodes of the top level. Keeps references. \param sensor the beams' origin
  /// in the robot frame
  TreeDescent(const SearchTree& tree, Range blocks, const BandQuery& query, const PosePrior& prior,
              const mrpt::math::TPoint2D& sensor, Workspace& workspace);

  /// Nothing waits any more: every pose that the prior allows is in a leaf, or there is none.
  bool isDone() const;

  /// Raises the limit: appends the (leaf, heading) pairs bounded within it that were not before.
  /// `is_spent` is asked now and then; true ends it early, with the leaves found by then.
  /// \returns false if so: there may be others within the limit
  bool expandUpTo(unsigned limit, const std::function<bool()>& is_spent, std::vector<Node>& leaves);

  /// For when there is no time: the leaves that a descent by the `width` least bounds of each level
  /// comes to.
  void greedyDescent(std::size_t width, std::vector<Node>& leaves);

  /// Nodes that were not opened, bounded below `bound`: what leaves may yet come from.
  std::size_t countBelow(unsigned bound) const;

  std::size_t evaluated() const { return evaluated_; }  ///< nodes bounded so far

 private:
  /// Bounds the children of nodes [first, last), which are of one index.
  void expand(std::size_t level, const std::vector<Node>& nodes, std::size_t first,
              std::size_t last);
  /// Bounds a node at the windows listed.
  void consider(std::size_t level, std::uint32_t index);
  void list(std::size_t level, std::uint32_t heading);
  void groupByIndex(std::size_t level, std::vector<Node>& nodes);
  bool allowsPosition(std::size_t level, std::uint32_t index) const;
  bool allowsHeading(std::size_t level, std::uint32_t heading) const;

  const SearchTree* tree_;
  std::array<Range, SearchTree::kLevels> ranges_;  ///< what the blocks hold, by level
  const BandQuery* query_;
  const PosePrior* prior_;
  double sensor_distance_;
  std::array<std::vector<char>, SearchTree::kLevels> allowed_;  ///< headings, by level
  Workspace* workspace_;
  unsigned limit_ = 0;
  std::size_t evaluated_ = 0;
};

}  // namespace mrpt_polyloc
