#pragma once

#include <mrpt_polyloc/localization/BandQuery.h>
#include <mrpt_polyloc/localization/CellTree.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <mrpt/math/TPoint2D.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// The way down a CellTree with a limit: what is bounded above it, or not allowed by the prior, is
/// left out.
class CellDescent {
 public:
  /// A node of the tree and a window of headings, the first bin of which is `heading`.
  struct Node {
    std::uint32_t index;
    std::uint32_t heading;
    unsigned bound;  ///< of the search cost [units of the query]
  };

  /// Keeps references. \param sensor the beams' origin in the robot frame
  CellDescent(const CellTree& tree, const BandQuery& query, const PosePrior& prior,
              const mrpt::math::TPoint2D& sensor);

  /// All windows of all blocks of the top level, block by block, those of the least bound first.
  std::vector<std::vector<Node>> top();

  /// The (cell, heading) pairs below nodes of one block of the top level within the limit.
  void descend(const std::vector<Node>& block, unsigned limit, std::vector<Node>& leaves);

  std::size_t evaluated() const { return evaluated_; }  ///< nodes so far

 private:
  void expand(std::size_t level, const std::vector<Node>& nodes, unsigned limit,
              std::vector<Node>& children);
  void consider(std::size_t level, std::uint32_t index, const CellTree::Bands& bands,
                std::uint32_t heading, unsigned limit, std::vector<Node>& nodes);
  bool allowsPosition(std::size_t level, std::uint32_t index) const;
  bool allowsHeading(std::size_t level, std::uint32_t heading) const;

  const CellTree* tree_;
  const BandQuery* query_;
  const PosePrior* prior_;
  double sensor_distance_;
  std::array<std::vector<char>, CellTree::kLevels> allowed_;  ///< headings, by level
  std::vector<Node> nodes_, children_;
  std::size_t evaluated_ = 0;
};

}  // namespace mrpt_polyloc
