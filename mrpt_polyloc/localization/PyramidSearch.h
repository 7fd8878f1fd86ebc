#pragma once

#include <mrpt_polyloc/localization/LocalizationResult.h>
#include <mrpt_polyloc/localization/SignaturePyramid.h>
#include <mrpt_polyloc/localization/SignatureQuery.h>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <cstddef>
#include <vector>

namespace mrpt_polyloc {

struct PyramidSearchParams {
  /// Poses within this share of the best cost, plus `margin`, are candidates: the codes are coarse,
  /// and the right pose is not always their best.
  double margin_share = 0.15;
  double margin = 2.0;               ///< in steps of RangeCode per used bin
  std::size_t max_candidates = 400;  ///< the search ends with so many different ones

  /// \throws InvalidParamsError naming the bad field.
  void check() const;
};

/// A pose that the codes speak for.
struct PyramidCandidate {
  mrpt::math::TPose2D pose_map_beams;
  unsigned cost = 0;  ///< sum over the bins, in steps of RangeCode
};

struct PyramidSearchResult {
  std::vector<PyramidCandidate> candidates;  ///< best first; one per cell of 0.3 m and 5.6 degrees
  std::size_t evaluated = 0;                 ///< blocks and headings whose bound was computed
};

/// Best-first branch and bound over (block, window of headings): the bound of a node is at most the
/// cost of every lattice pose in it, so the candidates are those an exhaustive comparison of all
/// lattice positions and headings would give, in the same order.
///
/// \param sensor the beams' origin in the robot frame, to hold `prior`, which speaks of the robot,
/// against
PyramidSearchResult searchPyramid(const SignaturePyramid& pyramid, const SignatureQuery& query,
                                  const PosePrior& prior, const mrpt::math::TPoint2D& sensor,
                                  const PyramidSearchParams& params = {});

/// The cost of a signature band at a heading (in bins): summed over the bins, the least cost that
/// any position and heading of the band can have.
unsigned bandCost(const SignatureBand& band, const SignatureQuery& query, std::size_t heading);

}  // namespace mrpt_polyloc
