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
/// start refinement: where the search cost is least, and where the clipped cost is. In a large
/// building many wrong places are half right for all beams; the right one, where the map is
/// incomplete, is exactly right for most and all wrong for the others.
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
  std::vector<PoseCandidate> best(std::size_t most) const { return best(search_, most, limit()); }

  /// The same of all leaves, if so few remain that every place can be looked at; else as best().
  /// A middle may cost much although the right pose is near: beside racks what is seen changes
  /// within a hand's breadth.
  std::vector<PoseCandidate> allIfFew(std::size_t most) const;
  /// The leaves of least clipped cost, one of each place, `most` at most: those nearly as good by
  /// it as the best of all.
  std::vector<PoseCandidate> mostExplained(std::size_t most) const;
  /// Whether every place can be looked at.
  bool areFew(std::size_t most) const;

  /// Leaves bounded below `bound` [units of the query].
  std::size_t countBelow(unsigned bound) const;

  /// What a leaf costs in its middle, at the best heading tried of its window [m].
  float cost(std::size_t i) const { return search_.costs[i]; }
  /// The same with all headings tried, if it may be `worthwhile` [m] or less: else the middle one
  /// alone may have been.
  float costIfWorthwhile(std::size_t i, float worthwhile);
  /// Where it costs that.
  mrpt::math::TPose2D pose(std::size_t i) const { return pose(search_, i); }
  TPoint2D middle(std::size_t i) const { return tree_.middle(leaves_[i].index); }
  SearchTree::Bands bands(std::size_t i) const { return tree_.bands(0, leaves_[i].index); }
  double leafSize() const { return tree_.leafSize(); }

 private:
  /// What leaves are chosen by: a cost of each, and the heading where it is that [bins].
  struct Merits {
    std::vector<float> costs;
    std::vector<std::uint32_t> headings;
    float least = std::numeric_limits<float>::infinity();
    void take(std::size_t i, float cost, std::uint32_t heading) {
      if (cost >= costs[i]) return;
      costs[i] = cost;
      headings[i] = heading;
    }
    void resize(std::size_t count) {
      costs.resize(count, std::numeric_limits<float>::infinity());
      headings.resize(count);
    }
  };
  std::vector<PoseCandidate> best(const Merits& merits, std::size_t most, double most_cost) const;
  void tryHeading(std::size_t i, std::uint32_t heading);
  void tryAllHeadings(std::size_t i);
  mrpt::math::TPose2D pose(const Merits& merits, std::size_t i) const;
  double limit() const;
  double clippedLimit() const;

  const SearchTree& tree_;
  const BandQuery& query_;
  const CertifiedSearchParams& params_;
  std::vector<TreeDescent::Node> leaves_;
  Merits search_, clipped_;  ///< in the middle of the leaves, least in the window [m]
};

}  // namespace mrpt_polyloc
