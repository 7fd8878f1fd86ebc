#pragma once

#include <mrpt_polyloc/base/export.h>

#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt_polyloc {

/// Scans that follow each other along a drive see nearly the same: they are right or wrong
/// together, and count as little more than one. Statistics therefore go over stretches of the
/// drive.
struct POLYLOC_EXPORT StretchParams {
  double length = 10.0;  ///< a stretch ends after so much way [m]: beyond a room, views differ
  double jump = 2.0;     ///< a step longer than this begins another stretch [m]
};

/// The stretch (from 0, rising) that each pose of a drive belongs to.
POLYLOC_EXPORT std::vector<std::size_t> stretchesOf(const std::vector<mrpt::math::TPose2D>& drive,
                                                    const StretchParams& params = {});

/// An interval of a share, [0, 1].
struct POLYLOC_EXPORT ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// The 95 % interval of the share of true values, by the percentile bootstrap (Efron 1979) over
/// stretches (clusters) rather than rows: whole stretches are drawn anew, with replacement.
///
/// Where all values are alike every resample is, too, and the bootstrap knows nothing: then the
/// exact interval of Clopper and Pearson for as many independent trials as there are stretches.
/// [0, 1] for no values. Deterministic for a seed. O(resamples * stretches)
/// \param stretch of each value, any numbers; as many as values
/// \throws InvalidParamsError if the sizes differ
POLYLOC_EXPORT ShareInterval shareInterval(const std::vector<bool>& values,
                                           const std::vector<std::size_t>& stretch,
                                           std::uint64_t seed = 1, std::size_t resamples = 2000);

/// The 95 % interval of the difference of two shares over the same scans, share of `a` minus share
/// of `b`, by the same bootstrap: stretches are drawn once for both (paired). [-1, 1] for no
/// values. Where the two never differ: by how much they could with 95 % confidence.
POLYLOC_EXPORT ShareInterval differenceInterval(const std::vector<bool>& a,
                                                const std::vector<bool>& b,
                                                const std::vector<std::size_t>& stretch,
                                                std::uint64_t seed = 1,
                                                std::size_t resamples = 2000);

}  // namespace mrpt_polyloc
