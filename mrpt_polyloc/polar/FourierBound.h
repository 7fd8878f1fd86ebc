#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/polar/PolarFunction.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

/// A vector x(f) that does not change when f is turned, and of which the Euclidean distance
/// |x(f) - x(g)| never exceeds the polar coordinate metric of f and g minimised over rotations:
///
/// x = ((2 pi)^(1/2) (|F_0|, 2^(1/2) |F_1|, ..., 2^(1/2) |F_order|), t), with F_j the Fourier
/// coefficients and t the norm of what they leave out, (||f||^2 - |x|^2)^(1/2). So |x| = ||f||.
/// Feed it to any nearest-neighbour search in the plane of vectors to prune.
///
/// From a PolarFunction it bounds the exact metric over all rotations, from samples the sampled one
/// over its k rotations; the two must not be mixed. [m rad^(1/2)]
/// \throws InvalidParamsError if the view is partial or, for k samples, order > (k - 1) / 2.
/// O(pieces * order), or O(k).
POLYLOC_EXPORT std::vector<double> fourierFeature(const PolarFunction& f, std::size_t order);
POLYLOC_EXPORT std::vector<double> fourierFeature(const SampledPolarFunction& f, std::size_t order);

}  // namespace mrpt_polyloc
