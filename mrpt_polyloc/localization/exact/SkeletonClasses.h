#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>
#include <mrpt_polyloc/visibility/VisibilitySkeleton.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// The cells of a map, sorted by what is seen from them: two are in one class if a rigid motion
/// carries the skeleton of one to that of the other. The points that VisibilityCells calls tied are
/// places of their own, as cells are.
///
/// With a compass, the class up to translation is those of its embeddings that turn as it says.
///
/// Skeletons are not kept but found again from a representative: memory is O(1) a cell. Immutable;
/// refers to the cells, which must outlive it.
class POLYLOC_EXPORT SkeletonClasses {
 public:
  /// Where a skeleton of the class is in the map.
  struct Embedding {
    std::int32_t cell;                      ///< VisibilityCells::kNone: a tied point
    mrpt::math::TPose2D pose_map_skeleton;  ///< carries the class's skeleton there
  };
  /// A class that may hold what is seen, and a motion that carries what is seen to its skeleton.
  struct Match {
    std::size_t index;
    mrpt::math::TPose2D pose_skeleton_robot;
  };

  /// \param tolerance of what is seen [m], as ExactLocalizerParams has it; the cells of a class
  /// agree to a thousandth of it. A view for each cell, and O(N log N) for N cells.
  SkeletonClasses(const VisibilityCells& cells, double tolerance);

  std::size_t size() const { return classes_.size(); }
  /// Calls visit(embedding) for those of a class, sorted by cell.
  template <class Visitor>
  void forEachEmbedding(std::size_t index, Visitor&& visit) const {
    const std::size_t end =
        index + 1 < size() ? classes_[index + 1].first_embedding : embeddings_.size();
    for (std::size_t e = classes_[index].first_embedding; e < end; ++e) visit(embeddings_[e]);
  }
  /// The skeleton of a class, in the map's frame where its representative is.
  VisibilitySkeleton skeleton(std::size_t index, ViewExpander& expander) const;

  /// All classes and motions that carry a skeleton to the class's within the tolerance. Classes are
  /// sorted by key and length of ring, so that none is missed at a border of buckets. O(log N) to
  /// look up and O(q) for each class found there.
  std::vector<Match> find(const VisibilitySkeleton& seen, ViewExpander& expander) const;

  std::size_t memory() const;  ///< [bytes], without the cells

 private:
  struct Class {
    std::uint64_t key;
    double ring_length;
    std::uint32_t place;  ///< of the representative: a cell, or cells.size() + a tied point
    std::uint32_t first_embedding;
  };
  VisibilitySkeleton skeletonAt(std::uint32_t place, ViewExpander& expander) const;
  std::vector<Class> sortedPlaces() const;

  const VisibilityCells* cells_;
  double tolerance_;
  std::vector<TPoint2D> tied_;
  std::vector<Class> classes_;  // by key and ring length
  std::vector<Embedding> embeddings_;
};

}  // namespace mrpt_polyloc
