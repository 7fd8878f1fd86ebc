#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/visibility/ViewExpander.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// What of a view is the same from all points of a visibility cell (doc/theory.md, definition 6):
/// the vertices of the map that are seen, counterclockwise, and in the gap behind each the line of
/// the one edge seen there, with how it ends: at the vertex before the gap, at the one after it, at
/// both, or at neither. Where windows end is not part of it. Anchored on vertices alone: a view
/// need not hold any edge in full.
///
/// A value: immutable, in the frame that it was built in.
class POLYLOC_EXPORT VisibilitySkeleton {
 public:
  struct Gap {
    TPoint2D vertex;  ///< seen, where the gap begins [m]
    TPoint2D a, b;    ///< two points of the edge's line, a before b counterclockwise [m]
    bool begins;      ///< the edge begins at `vertex`
    bool ends;        ///< the edge ends at the vertex of the next gap
  };

  /// \param gaps counterclockwise around a viewpoint \throws InvalidParamsError if there are none
  explicit VisibilitySkeleton(std::vector<Gap> gaps);

  const std::vector<Gap>& gaps() const { return gaps_; }
  std::size_t size() const { return gaps_.size(); }

  /// Equal for skeletons that are equal up to a motion, whatever gap they start with: a hash of
  /// the cyclic list of how edges end. Only counted, never rounded: it cannot miss.
  std::uint64_t key() const { return key_; }
  /// Equal up to rounding for these [m]: the length of the ring of vertices. Vertices off by t
  /// change it by 2 t size() at most.
  double ringLength() const { return ring_length_; }

  /// The gap at which the least list of endings starts; it starts there again every period() gaps.
  std::size_t start() const { return start_; }
  std::size_t period() const { return period_; }

 private:
  std::vector<Gap> gaps_;
  std::uint64_t key_ = 0;
  double ring_length_ = 0.0;
  std::size_t start_ = 0, period_ = 1;
};

/// The skeleton of a view into free space alone (ViewExpander with stop_at_open), from a viewpoint
/// that is not in line with two vertices seen. Vertices within `flat` [m] of the line through their
/// neighbours on the boundary are left out.
POLYLOC_EXPORT VisibilitySkeleton skeletonOf(const Triangulation& triangulation, const View& view,
                                             double flat);

/// The skeleton of a visibility cell, in the map's frame; `expander` is one of the cells'
/// triangulation that stops at open edges. A view: a few microseconds.
POLYLOC_EXPORT VisibilitySkeleton skeletonOf(const VisibilityCells& cells, std::size_t cell,
                                             ViewExpander& expander, double flat);

/// All rigid motions (without reflection) that carry `from` to `to`: each turns by phi about the
/// origin, then moves by (x, y), by least squares over the vertices. Vertices may then be
/// `tolerance` apart, as may lines from the points given of the shorter piece, by more the farther
/// these are off the vertices. More than one for a symmetric skeleton. O(q) each, q gaps.
POLYLOC_EXPORT std::vector<mrpt::math::TPose2D> alignments(const VisibilitySkeleton& from,
                                                           const VisibilitySkeleton& to,
                                                           double tolerance);

}  // namespace mrpt_polyloc
