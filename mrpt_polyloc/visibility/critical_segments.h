#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/geometry/Triangulation.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace mrpt_polyloc {

/// A critical segment: it starts at a reflex vertex, the *blocker* v, and leads away from a vertex
/// u that v sees, along the line u v, which supports free space at v. Crossing it, u appears or
/// disappears behind v. All numbers are vertices of the triangulation.
struct CriticalSegment {
  std::int32_t behind;          ///< u, the nearest one on the line
  std::int32_t blocker;         ///< v, where the segment starts
  std::int32_t right, left;     ///< it ends on the edge from `right` to `left`; one vertex if equal
  bool obstacle_left;           ///< the obstacle at v lies left of the direction u to v
  std::uint32_t first_flipped;  ///< into CriticalSegments::flipped
  std::uint32_t flipped_count;  ///< u, and vertices behind u on the same line that flip with it
};

struct CriticalSegments {
  std::vector<CriticalSegment> segments;
  std::vector<std::int32_t> flipped;
};

/// Where sight is unlimited.
constexpr double kUnlimitedRange = std::numeric_limits<double>::infinity();

/// All critical segments of the free space of a triangulation; open edges are boundary, as walls
/// are. Each is cut at the first vertex that it touches (what goes on behind is that vertex' own
/// segment); those that run along the boundary are left out. Decided by exact orientation.
///
/// With a finite range R [m] only pairs with |uv| < R count, and a segment ends on the first edge
/// of the triangulation at least R - |uv| away from v.
///
/// The views from all reflex vertices by triangular expansion, and a walk for each segment:
/// O(r n + S n) at worst, mostly far less.
CriticalSegments criticalSegments(const Triangulation& triangulation,
                                  double range = kUnlimitedRange);

/// Where a segment ends [m], rounded.
POLYLOC_EXPORT TPoint2D endOf(const CriticalSegment& segment,
                              const std::vector<TPoint2D>& vertices);

}  // namespace mrpt_polyloc
