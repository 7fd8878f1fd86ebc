#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/scan/PosePrior.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/localization/search/TreeDescent.h>

#include <mrpt/math/TPoint2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// The way down from all blocks of a SearchTree's top level. They are descended in parts, each by
/// one thread at a time; which leaves come out, and in which order, does not depend on the parts.
class ForestDescent {
 public:
  /// Of each part; kept from one descent to the next.
  using Workspace = std::vector<TreeDescent::Workspace>;

  /// Bounds the blocks. Keeps references. \param sensor the beams' origin in the robot frame
  /// \param max_nodes end after so many nodes bounded, as if the budget were spent; 0: never. All
  /// is one part then, so that it always ends at the same node.
  ForestDescent(const SearchTree& tree, const BandQuery& query, const PosePrior& prior,
                const mrpt::math::TPoint2D& sensor, const Budget& budget, std::size_t max_nodes,
                Workspace& workspace);

  /// As those of TreeDescent, of all parts.
  bool isDone() const;
  bool expandUpTo(unsigned limit, std::vector<TreeDescent::Node>& leaves);
  void greedyDescent(std::size_t width, std::vector<TreeDescent::Node>& leaves);
  std::size_t countBelow(unsigned bound) const;
  std::size_t evaluated() const;

 private:
  const Budget* budget_;
  std::size_t max_nodes_;
  std::vector<TreeDescent> parts_;
  std::vector<std::vector<TreeDescent::Node>> leaves_;  ///< of each part, on their way out
};

}  // namespace mrpt_polyloc
