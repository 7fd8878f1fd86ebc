#pragma once

#include <mrpt_polyloc/base/export.h>

#include <vector>

namespace mrpt_polyloc {

/// One threshold of a detector that accepts scores at or above it.
struct POLYLOC_EXPORT RocPoint {
  double threshold = 0.0;
  double lost = 0.0;     ///< share of the true that is refused: scores below the threshold
  double refused = 0.0;  ///< share of the foreign that is refused
};

/// Every point of the curve that the scores of true and foreign examples make, by rising
/// threshold: from nothing refused to (threshold infinity) everything refused. Of equal scores
/// both classes fall at once. O(n log n).
/// \throws InvalidParamsError if a class is empty or a score is not a number
POLYLOC_EXPORT std::vector<RocPoint> rocCurve(std::vector<double> true_scores,
                                              std::vector<double> foreign_scores);

/// Area under the curve: the probability that a true example scores above a foreign one, ties
/// counted half.
POLYLOC_EXPORT double rocArea(const std::vector<RocPoint>& curve);

/// The last point at which at most this share of the true is lost.
POLYLOC_EXPORT RocPoint pointAtLoss(const std::vector<RocPoint>& curve, double share);

}  // namespace mrpt_polyloc
