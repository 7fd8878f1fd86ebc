#pragma once

#include <mrpt/math/TPoint2D.h>

#include <optional>
#include <utility>
#include <vector>

namespace mrpt_polyloc {

/// An edge of free space, free on its left [m].
struct BorderEdge {
  mrpt::math::TPoint2D from, to;
};

/// A closed interval [m].
using Stretch = std::pair<double, double>;

/// Where along `base` (from its begin, in its direction) a robot at `distance` left of its line
/// sees within `range` nothing but the line of `base`, covered by edges, and, if `opposite` is
/// given, edges on the parallel line so far left of it that face it. Stretches of a length up to
/// the tolerance are points; sorted. Only those that hold a chord that begins on `base` itself.
/// O(n log n) for n edges.
std::vector<Stretch> clearStretches(const std::vector<BorderEdge>& edges, const BorderEdge& base,
                                    double distance, std::optional<double> opposite, double range,
                                    double tolerance);

}  // namespace mrpt_polyloc
