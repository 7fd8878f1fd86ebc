#pragma once

#include <mrpt_polyloc/base/Budget.h>
#include <mrpt_polyloc/localization/search/BandQuery.h>
#include <mrpt_polyloc/localization/search/CertifiedSearchParams.h>
#include <mrpt_polyloc/localization/search/PoseCandidate.h>
#include <mrpt_polyloc/localization/search/SearchTree.h>
#include <mrpt_polyloc/localization/search/TreeDescent.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

/// The leaves that a descent comes to, with what they cost in the middle, and from them where to
/// start refinement.
class SeedPoses {
 public:
  /// Keeps references.
  SeedPoses(const SearchTree& tree, const BandQuery& query, const CertifiedSearchParams& params)
      : tree_(tree), query_(query), params_(params) {}

  /// With windows of headings; a descent appends to them.
  std::vector<TreeDescent::Node>& leaves() { return leaves_; }
  const std::vector<TreeDescent::Node>& leaves() const { return leaves_; }

  /// Takes the leaves added since. \param budget its threads alone
  void evaluate(const Budget& budget = Budget());

  /// The best leaf of each place, of those within the starting margin of the best of all.
  std::vector<PoseCandidate> best(std::size_t most) const { return best(most, limit()); }

  /// The same of all leaves, if so few remain that every place can be looked at; else as best().
  /// A middle may cost much although the right pose is near: beside racks what is seen changes
  /// within a hand's breadth.
  std::vector<PoseCandidate> allIfFew(std::size_t most) const;
  /// Whether every place can be looked at.
  bool areFew(std::size_t most) const;

  /// Leaves bounded below `bound` [units of the query].
  std::size_t countBelow(unsigned bound) const;

  /// What a leaf costs in its middle, at the best heading tried of its window [m].
  float cost(std::size_t i) const { return costs_[i]; }
  /// The same with all headings tried, if it may be `worthwhile` [m] or less: else the middle one
  /// alone may have been.
  float costIfWorthwhile(std::size_t i, float worthwhile);
  /// Where it costs that.
  mrpt::math::TPose2D pose(std::size_t i) const;
  TPoint2D middle(std::size_t i) const { return tree_.middle(leaves_[i].index); }
  SearchTree::Bands bands(std::size_t i) const { return tree_.bands(0, leaves_[i].index); }
  double leafSize() const { return tree_.leafSize(); }

 private:
  std::vector<PoseCandidate> best(std::size_t most, double most_cost) const;
  void tryAllHeadings(std::size_t i);
  double limit() const;

  const SearchTree& tree_;
  const BandQuery& query_;
  const CertifiedSearchParams& params_;
  std::vector<TreeDescent::Node> leaves_;
  std::vector<float> costs_;             ///< in the middle of the leaves [m]
  std::vector<std::uint32_t> headings_;  ///< of the least cost in the window
  float least_ = std::numeric_limits<float>::infinity();
};

}  // namespace mrpt_polyloc
