#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/LocalizationResult.h>

#include <mrpt/math/TPose2D.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// How far from the truth still counts as right.
struct POLYLOC_EXPORT Tolerance {
  double distance = 0.3;               ///< [m]
  double angle = 0.08726646259971647;  ///< [rad], 5 degrees
};

/// One localized scan against its truth.
struct POLYLOC_EXPORT ScanScore {
  LocalizationStatus status = LocalizationStatus::too_few_beams;
  /// Rank (from 1) of the first right hypothesis; 0 if none is right or none was given.
  std::size_t right_rank = 0;
  double error_m = 0.0;     ///< of the first hypothesis; NaN if there is none
  double error_rad = 0.0;   ///< of the first hypothesis; NaN if there is none
  double ms = 0.0;          ///< search and refinement
  bool in_ellipse = false;  ///< the truth is in some hypothesis's ellipse, see isInEllipse()
};

/// Whether a pose lies within both tolerances of the truth (inclusive), headings compared modulo
/// 2 pi.
POLYLOC_EXPORT bool isRight(const mrpt::math::TPose2D& pose, const mrpt::math::TPose2D& truth,
                            const Tolerance& tolerance = {});

/// Whether a pose lies within so many standard deviations of a hypothesis: a Mahalanobis distance
/// over (x, y, phi), headings compared modulo 2 pi. Never where the covariance is not positive
/// definite.
POLYLOC_EXPORT bool isInEllipse(const mrpt::math::TPose2D& pose, const Hypothesis& hypothesis,
                                double deviations = 3.0);

/// Compares the answer to one scan with the truth, see isRight().
POLYLOC_EXPORT ScanScore scoreScan(const LocalizationResult& result,
                                   const mrpt::math::TPose2D& truth,
                                   const Tolerance& tolerance = {});

/// The percentile of values by linear interpolation between order statistics: share 0 is the
/// least, 1 the greatest, 0.5 the median (the mean of the two middle ones if their number is even).
/// NaN if there are no values. O(n).
POLYLOC_EXPORT double percentile(std::vector<double> values, double share);

/// Success rates and times over many scans, as summary.json holds them. All zero for no scans.
struct POLYLOC_EXPORT Summary {
  std::size_t scans = 0;
  double top1 = 0, top5 = 0, top20 = 0;  ///< fractions with a right pose among the first k
  double in_list = 0;                    ///< fraction with a right pose anywhere
  double in_ellipse = 0;  ///< fraction with the truth within three deviations of a hypothesis
  std::optional<double> unique_right;                      ///< of those called unique, right ones
  std::optional<double> median_error_m, median_error_deg;  ///< over right first answers
  double ms_median = 0, ms_p90 = 0, ms_max = 0;            ///< see percentile()
  std::array<std::size_t, 4> status{};                     ///< counts, by LocalizationStatus
};

/// The summary of those scores whose indices are given; of all if `rows` is null. Scans called
/// no_match or too_few_beams count as misses.
/// \throws std::out_of_range if there is no score of that index.
POLYLOC_EXPORT Summary summarize(const std::vector<ScanScore>& scores,
                                 const std::vector<std::size_t>* rows = nullptr);

}  // namespace mrpt_polyloc
