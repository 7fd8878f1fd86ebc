#pragma once

#include <mrpt_polyloc/polar/PolarFunction.h>

/// What the sampled metric is held against. No program needs it, so it is not in the library.
namespace mrpt_polyloc {

/// The polar coordinate metric as an integral, with a compass:
/// (Integral (f(phi - rotation) - g(phi))^2 dphi)^(1/2) over the directions that both see.
///
/// In closed form between merged breakpoints, without subtracting large terms where the functions
/// are close: relative error about 1e-12 for walls against walls, parallel or not; against arcs
/// the square is right to 1e-13 maximum()^2, and so the distance of nearly equal functions to
/// 3e-7 maximum(). A wall seen at a grazing angle costs a share 1e-16 / cosine of its part.
/// A metric on complete views (rotation 0). [m rad^(1/2)]
/// \throws InvalidParamsError if rotation is not finite or the views have no direction in common.
/// O(p + q) for p and q pieces.
double distance(const PolarFunction& f, const PolarFunction& g, double rotation = 0.0);

}  // namespace mrpt_polyloc
