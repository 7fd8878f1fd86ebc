#pragma once

#include <mrpt_polyloc/polar/PolarFunction.h>
#include <mrpt_polyloc/polar/RotationRange.h>

#include <cstddef>

/// Lower bounds of the exact polar coordinate metric, from the cheapest to the closest; see also
/// FourierBound.h, BinMeansBound.h. All throw InvalidParamsError for a partial view. [m rad^(1/2)]
namespace mrpt_polyloc {

/// | ||f|| - ||g|| |, for all rotations. O(1).
double normBound(const PolarFunction& f, const PolarFunction& g);

/// (2 pi)^(1/2) | mean f - mean g |, for all rotations (Jensen). O(pieces).
double meanBound(const PolarFunction& f, const PolarFunction& g);

/// For the rotations of `range`: the part of the metric in the frequencies up to `order`, minimised
/// over the rotation, and the difference of the norms of what is left (turning mixes no
/// frequencies).
///
/// The correlation of the low parts is a trigonometric polynomial C. It is computed at 16 angles
/// per period of its highest frequency; its maximum, where C' = 0 or at an end of the range,
/// exceeds the greatest of them by at most h^2 / 2 max |C''|, h half their spacing, and by
/// Bernstein's inequality max |C''| <= order^2 max |C|. \throws InvalidParamsError if the range is
/// bad. O((pieces + order) order).
double lowPassBound(const PolarFunction& f, const PolarFunction& g, std::size_t order,
                    const RotationRange& range = {});

/// With a compass, at rotation 0: the circle in `bins` equal bins, in each the means of f and g
/// (Jensen). \throws InvalidParamsError if bins is 0. O(pieces + bins).
double binMeansBound(const PolarFunction& f, const PolarFunction& g, std::size_t bins);

}  // namespace mrpt_polyloc
