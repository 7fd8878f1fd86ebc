#pragma once

#include <mrpt_polyloc/localization/ranking/Hypothesis.h>
#include <mrpt_polyloc/localization/ranking/LocalizationStatus.h>
#include <mrpt_polyloc/localization/ranking/MatchFeatures.h>

#include <optional>
#include <vector>

namespace mrpt_polyloc {

/// What refined poses mean: the part of a LocalizationResult that ranking decides.
struct Assessment {
  LocalizationStatus status = LocalizationStatus::no_match;
  double match_probability = 0.0;         ///< see LocalizationResult
  std::optional<MatchFeatures> features;  ///< of the best answer, if there is one
  std::vector<Hypothesis> hypotheses;     ///< best first
  double listed = 0.0;                    ///< see LocalizationResult
  double wheel_scale = 1.0;               ///< see LocalizationResult
};

}  // namespace mrpt_polyloc
