#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>
#include <mrpt_polyloc/geometry/WallDistances.h>
#include <mrpt_polyloc/visibility/BeamPattern.h>
#include <mrpt_polyloc/visibility/VisibleEdgeIndex.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What the map predicts for the beams of one or more poses, in the beams' own order, pose by pose
/// [m]. `wall[i]`: range to the first wall, infinity where there is none, or none before the beam
/// has gone as far as the horizon past where it left free space. `open[i]`: range at which the beam
/// first left free space for unknown space before a wall, else infinity.
struct POLYLOC_EXPORT PredictedRanges {
  std::vector<float> wall;
  std::vector<float> open;
};

/// The line of the first wall that each beam of one pose hits, in the beam frame: its normal
/// divided by its distance [1/m]. The range to the wall is 1 / (along * cos(bearing) + across *
/// sin(bearing)); both are 0 where no wall is hit.
struct POLYLOC_EXPORT PredictedHits {
  std::vector<float> along, across;
};

/// Predicts ranges from the lists of a VisibleEdgeIndex: along an edge on the line n.x = h the
/// inverse range is (n.u)/h, linear in the beam's direction u, so an edge fills the beams it covers
/// with two multiplications and a maximum each, and the depth buffer on inverse ranges needs no
/// order among the edges.
///
/// Single precision: within 1e-5 of the range, except for beams that pass a vertex, or meet a wall,
/// within some 1e-6 rad.
/// Cost: a few ns per listed edge and 0.1 ns per covered beam. Const and thread-safe. A pose
/// outside the indexed squares is answered from all edges, more slowly.
class POLYLOC_EXPORT RangePredictor {
 public:
  /// Side of the squares [m]: the measured optimum between long lists and many squares on floor
  /// plans.
  static constexpr double kSquareSize = 0.5;

  /// Keeps no reference to the triangulation. \param threads for the index; 0: all cores
  /// \param horizon so far past the first open edge a beam meets what the map knows [m]
  explicit RangePredictor(const Triangulation& triangulation, double square_size = kSquareSize,
                          int threads = 0, double horizon = VisibleEdgeIndex::kHorizon,
                          BuildProgress* progress = nullptr);

  /// With lists found before. \throws InvalidMapError unless they may be those of the map
  RangePredictor(const Triangulation& triangulation, VisibleEdgeIndex::Lists lists);

  /// The ranges from one pose of the beam frame (see RangeScan) in the map. All infinite outside
  /// the triangulated box, and for a pose that is not finite.
  void predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
               PredictedRanges& out) const;

  /// The same for many poses, in an order that keeps memory warm.
  void predict(const std::vector<mrpt::math::TPose2D>& poses, const BeamPattern& beams,
               PredictedRanges& out) const;

  /// The lines that are hit from one pose: what refinement needs, ranges with derivatives.
  void predict(const mrpt::math::TPose2D& pose_map_beams, const BeamPattern& beams,
               PredictedHits& out) const;

  const VisibleEdgeIndex& index() const { return index_; }
  const WallDistances& wallDistances() const { return wall_distances_; }

 private:
  struct Workspace;
  static Workspace& workspace();  ///< of the calling thread, kept between calls
  template <class Depths>
  void look(const mrpt::math::TPose2D& pose, std::int64_t square, const BeamPattern& beams,
            Workspace& workspace, Depths& wall, FloatBlocks* open) const;
  void predict(const mrpt::math::TPose2D& pose, std::int64_t square, const BeamPattern& beams,
               Workspace& workspace, float* wall, float* open) const;

  BoundingBox box_;
  VisibleEdgeIndex index_;
  WallDistances wall_distances_;
};

}  // namespace mrpt_polyloc
