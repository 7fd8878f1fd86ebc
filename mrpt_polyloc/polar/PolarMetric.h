#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/polar/RotationRange.h>
#include <mrpt_polyloc/polar/SampledPolarFunction.h>

#include <cstddef>

namespace mrpt_polyloc {

/// The polar coordinate metric, sampled, with a compass:
/// ((2 pi / k) Sum_i (f_i - g_i)^2)^(1/2), over the samples that are valid in both.
///
/// A metric on complete views. It differs from the integral over the circle by the jumps:
/// |distance^2 - integral| <= (2 pi / k) TV((f - g)^2).
/// \throws InvalidParamsError if the numbers of samples differ or no sample is valid in both.
/// [m rad^(1/2)], O(k).
POLYLOC_EXPORT double distance(const SampledPolarFunction& f, const SampledPolarFunction& g);

/// The rotation under which two views agree best.
struct POLYLOC_EXPORT RotationMatch {
  double distance = 0.0;        ///< of the views when f is turned by `rotation` [m rad^(1/2)]
  std::size_t index = 0;        ///< rotation = 2 pi index / k
  double rotation = 0.0;        ///< f turned counterclockwise by this fits g best [rad], [0, 2 pi)
  double finer_rotation = 0.0;  ///< of the parabola through its neighbours, within half a step
};

/// The polar coordinate metric, sampled, without a compass: the least distance(f turned, g) over
/// the k rotations by multiples of 2 pi / k, or over those in `range` (the nearest one to its
/// centre if there is none). One of the views must be complete; a partial one is compared where it
/// sees.
///
/// By a Fourier transform in single precision, then afresh in double for every rotation that its
/// rounding leaves in doubt: `distance` is the true minimum. Equally good rotations: the one of
/// least index.
/// \throws InvalidParamsError if the numbers of samples differ, if both views are partial, or if
/// the range is bad.
/// [m rad^(1/2)], O(k log k) and O(k) for each rotation in doubt.
POLYLOC_EXPORT RotationMatch distanceOverRotations(const SampledPolarFunction& f,
                                                   const SampledPolarFunction& g,
                                                   const RotationRange& range = {});

}  // namespace mrpt_polyloc
