#pragma once

#include <mrpt_polyloc/base/export.h>
#include <mrpt_polyloc/localization/exact/ExactAnswers.h>
#include <mrpt_polyloc/localization/exact/LimitedAnswers.h>
#include <mrpt_polyloc/localization/ranking/Assessment.h>
#include <mrpt_polyloc/localization/search/Certificate.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// What the search did.
struct POLYLOC_EXPORT SearchStatistics {
  std::size_t positions = 0;   ///< candidate positions, or cells, in the index
  std::size_t evaluated = 0;   ///< nodes whose cost was bounded or evaluated
  std::size_t refined = 0;     ///< candidates refined
  double search_ms = 0.0;      ///< wall time of the search
  double refinement_ms = 0.0;  ///< wall time of refinement, ranking and merging
};

/// All hypotheses for one scan, best first; empty unless status is unique or ambiguous.
struct POLYLOC_EXPORT LocalizationResult {
  LocalizationStatus status = LocalizationStatus::too_few_beams;
  /// Probability that the scan was taken in this map, as far as its best answer tells (see
  /// MatchFeatures), if as many scans are foreign as are not; 0 where nothing was found.
  double match_probability = 0.0;
  std::optional<MatchFeatures> features;  ///< of the best answer, if there is one
  std::vector<Hypothesis> hypotheses;
  /// Share of the posterior that the hypotheses hold: the sum of their weights, below 1 where more
  /// were found than asked for; 0 without any.
  double listed = 0.0;
  /// Of a scan set: so many times worse than they say the wheels were taken to be, by what the
  /// scans make of the drive; at least 1 (see doubtWheels()).
  double wheel_scale = 1.0;
  std::optional<Certificate> certificate;  ///< of the certified search alone
  std::vector<PoseRegion> regions;         ///< if asked for
  SearchStatistics statistics;
};

/// A result that holds what ranking decided, and nothing else yet.
POLYLOC_EXPORT LocalizationResult resultOf(Assessment assessment);

/// Exact answers as hypotheses: equal weights, cost 0, covariance of the tolerance; unique,
/// ambiguous or no_match. \param max_hypotheses at most so many are returned
POLYLOC_EXPORT LocalizationResult resultOf(const ExactAnswers& answers, double tolerance,
                                           std::size_t max_hypotheses);

/// The same where sight is limited: first the points; then the segments, each by its middle, with
/// the variance of a uniform spread along it; last the region, by the point of it farthest from
/// the border, with the range as the deviation of its place and a uniform spread of the heading.
POLYLOC_EXPORT LocalizationResult resultOf(const LimitedAnswers& answers, double tolerance,
                                           std::size_t max_hypotheses);

}  // namespace mrpt_polyloc
