#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/ranking/MatchFeatures.h>

#include <array>

namespace mrpt_polyloc {

/// The constants that turn costs into probabilities: fitted by polyloc-calibrate on scans whose
/// poses are known and on scans of other buildings. The defaults are its output on seven data sets
/// (default_calibration.h says which and how).
struct POLYLOC_EXPORT Calibration {
  Calibration();  ///< the built-in constants

  /// The logistic score of "this scan was taken in this map": intercept and one weight for each of
  /// MatchFeatures::values(), for as many foreign scans as true ones.
  double match_intercept;
  std::array<double, MatchFeatures::kCount> match_weights;
  /// Below this probability the answer is `no_match`; 0: never.
  double least_match_probability;
  /// Other thresholds for that, rising: of the scans that it was fitted on, taken in the map and in
  /// agreement with it, each refuses the share kLostShares.
  std::array<double, 8> lost_thresholds;
  static constexpr std::array<double, 8> kLostShares = {0.0,  0.001, 0.003, 0.005,
                                                        0.01, 0.02,  0.03,  0.05};

  /// Weights fall by exp(-weight_decay) for each standard error by which a hypothesis falls behind
  /// the first.
  double weight_decay;
  /// From this probability of the first hypothesis on (its weight times that of a match) the answer
  /// is `unique`; above 1: never.
  double unique_probability;

  /// Standard deviations are those of the refinement times these.
  double position_factor;
  double heading_factor;

  /// \throws InvalidParamsError naming the bad field.
  void check() const;

  /// The threshold that loses at most this share [0, 1] of true scans: that of the greatest of
  /// kLostShares that is not above it.
  double thresholdFor(double lost) const;

  /// The probability that the scan was taken in the map, in [0, 1].
  double matchProbability(const MatchFeatures& features) const;
};

}  // namespace mrpt_polyloc
